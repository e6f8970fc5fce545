#pragma once

#include <Eigen/Geometry>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"

namespace berth {

/// The pixels whose centre rays may meet the box, which stands in frame L: the bounding rectangle
/// of its projected corners, clipped to the image; the whole image where the box reaches the
/// camera's plane (z < 1 mm), and no pixel where all of it is behind (z <= 0).
PixelRect project_box(const Eigen::AlignedBox3f& box_L, const Pose& X_CL, const Camera& camera);

}  // namespace berth
