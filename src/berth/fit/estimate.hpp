// The unknowns of the fit: of each camera and, shared by all, of the joints.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "berth/types/camera.hpp"

namespace berth {

/// The belief about one camera. A reading z shows a surface at depth_offset_m +
/// depth_scale z.
struct CameraEstimate {
  Pose X_PC = unset_pose();
  /// Added to the clock offset that the calibration started from.
  double clock_shift_s = 0;
  double depth_offset_m = 0;
  double depth_scale = 1;
  /// How many pixels wider than its model the camera sees the robot, on each side.
  double dilation_px = 0;

  float corrected(float z_m) const {
    return static_cast<float>(depth_offset_m + depth_scale * z_m);
  }
};

struct CalibrationEstimate {
  /// One for each camera of the calibration.
  std::vector<CameraEstimate> cameras;
  /// Added to each of RobotModel::joints, rad or m.
  std::vector<double> joint_shift;
};

/// The places of a camera's unknowns in its own rows: a small rotation, then a small move of the
/// robot in the camera's frame C, about the middle of what is seen of it.
enum CameraUnknown {
  kRotation = 0,
  kMove = 3,
  kDepthOffset = 6,
  kDepthScale = 7,
  kDilation = 8,
  kClock = 9,
  kCameraUnknowns = 10,
};

}  // namespace berth
