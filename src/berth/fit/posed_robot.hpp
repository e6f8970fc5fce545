// For watch/ and calibration/: the robot as a camera has it before it, and how it moves there with
// each unknown.
#pragma once

#include <optional>
#include <vector>

#include "berth/fit/calibration_data.hpp"
#include "berth/fit/estimate.hpp"
#include "berth/robot/kinematics.hpp"

namespace berth {

/// A velocity of a rigid body in the camera's frame C: a point p_C of it moves by turn x p_C +
/// move.
struct Twist {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  Eigen::Vector3d move = Eigen::Vector3d::Zero();

  Eigen::Vector3d at(const Eigen::Vector3d& p_C_m) const { return turn.cross(p_C_m) + move; }
  Twist& operator+=(const Twist& other) {
    turn += other.turn;
    move += other.move;
    return *this;
  }
  Twist operator*(double factor) const { return {turn * factor, move * factor}; }
};

struct PosedRobot {
  RobotPose pose;
  Pose X_BC = unset_pose();
  /// per_joint[link][j]: of the link, as the camera sees it, for each rad or m of joint j of
  /// RobotModel::joints. Empty unless asked for.
  std::vector<std::vector<Twist>> per_joint;
  /// per_second[link]: for each second that the camera's clock is shifted. Empty unless asked for.
  std::vector<Twist> per_second;
};

struct PosedRobotRequest {
  bool per_joint = false;
  bool per_second = false;
};

/// Nothing where the shifted time lies outside of the joints' samples.
std::optional<PosedRobot> pose_robot(const CalibrationData& calibration_data, std::size_t camera,
                                     const CalibrationFrame& frame,
                                     const CalibrationEstimate& estimate,
                                     const PosedRobotRequest& request);

}  // namespace berth
