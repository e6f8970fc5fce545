#pragma once

#include "berth/types/camera.hpp"

namespace berth {

/// The camera itself. Throws std::invalid_argument where its size or focal lengths are not positive
/// and finite, or its principal point is not finite.
const Camera& checked(const Camera& camera);

/// Throws std::invalid_argument where the camera's pose is not finite.
void require_finite(const Pose& X_BC);

}  // namespace berth
