// Inside render/ only.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// One link as one camera sees it.
struct LinkInImage {
  LinkId id = kNoLink;
  /// Where it may be seen; nothing of it is drawn outside.
  PixelRect rect;
  /// (u z, v z, z) of a point (x, y, z, 1) of the link's frame L.
  Eigen::Matrix<double, 3, 4> to_pixel_L;
  /// From here on single precision projects the link right within 1e-3 px.
  double single_precision_from_m = 0;
};

inline Eigen::Matrix<double, 3, 4> to_pixel(const Camera& camera, const Pose& X_CL) {
  Eigen::Matrix3d intrinsics;
  intrinsics << camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1;
  return intrinsics * X_CL.matrix().topRows<3>();
}

/// A coordinate of the link's frame is off by up to 2^-24 of itself, some times over: divided by
/// the depth and multiplied by the focal length, that is the error in the image.
inline double single_precision_from_m(const Camera& camera, const Eigen::AlignedBox3f& box_L_m) {
  constexpr double kLoss = 5 * 0x1p-24;
  constexpr double kLargestError_px = 1e-3;
  const auto largest_m = box_L_m.min().cwiseAbs().cwiseMax(box_L_m.max().cwiseAbs()).norm();
  return kLoss / kLargestError_px * std::max(camera.fx_px, camera.fy_px) * largest_m;
}

}  // namespace berth
