// What is too small to hide anybody does not hide: the definition as it is written down.
#pragma once

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"

namespace berth::sim {

/// What each pixel frees (`own_m`), raised where no ball of the diameter d could stand at that
/// depth that the camera would have missed; the slow twin of close_free_depth().
DepthImage plainly_closed(const Camera& camera, const DepthImage& own_m,
                          double detection_capability_m);

}  // namespace berth::sim
