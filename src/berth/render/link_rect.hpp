#pragma once

#include <Eigen/Geometry>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"

namespace berth {

/// The pixels whose centre rays may meet the box, which stands in frame L: the bounding rectangle
/// of its projected corners, clipped to the image; the whole image where the box reaches behind the
/// camera's plane (z <= 0), and no pixel where all of it is behind.
PixelRect project_box(const Eigen::AlignedBox3f& box_L, const Pose& X_CL, const Camera& camera);

}  // namespace berth
