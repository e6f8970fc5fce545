// Inside calibration/ only.
#pragma once

#include "berth/fit/fit.hpp"

namespace berth {

/// One standard deviation of what was found of a camera.
struct CameraDeviation {
  Eigen::Vector3d xyz_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
  double clock_s = 0;
  double depth_offset_m = 0;
  double depth_scale = 0;
  /// Of the middle of what is seen of the robot.
  double robot_m = 0;
};

/// From the fit's own equations, but no less than two fits to half of the frames each differ: the
/// equations take errors for independent that are not.
CameraDeviation deviation_of(const FitResult& fitted, const FitResult& even, const FitResult& odd,
                             std::size_t camera);

/// Whether a fit of all joints reports each joint's zero, in the order of RobotModel::joints. What
/// others may take its place for (the first joint the camera's pose, the last one nothing that can
/// be seen) is in its deviation.
std::vector<bool> determined_joints(const FitResult& fitted);

}  // namespace berth
