// The pinhole camera. This file is the one place that states the pixel convention.
#pragma once

#include <Eigen/Geometry>
#include <limits>

namespace berth {

/// Intrinsics as in a ROS camera_info or in OpenCV: integer coordinates are pixel **centres**, so pixel
/// (u, v) covers [u - 1/2, u + 1/2] x [v - 1/2, v + 1/2]. The optical frame (REP 103) has z forward,
/// x right, y down. A point p_C projects to u = fx p.x / p.z + cx.
struct Camera {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;
  double cy_px = 0;

  /// The thesis puts a pixel's **corner** at (u, v): its formulas hold with these two (Hirt 2.10 to 2.18).
  double corner_cx_px() const { return cx_px + 0.5; }
  double corner_cy_px() const { return cy_px + 0.5; }
};

/// X_BC: the pose of frame C in frame B.
using Pose = Eigen::Isometry3d;

/// A pose that nobody has set: NaN, so that it cannot pass for one.
inline Pose unset_pose() {
  Pose X = Pose::Identity();
  X.matrix().topRows<3>().setConstant(std::numeric_limits<double>::quiet_NaN());
  return X;
}

}  // namespace berth
