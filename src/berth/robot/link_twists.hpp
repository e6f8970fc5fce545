#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth {

/// How a rigid link moves in the root link's frame B: a point p of it moves by
/// linear_B_m_s + angular_B_rad_s x (p - origin of L).
struct LinkTwist {
  /// Of the link frame's origin.
  Eigen::Vector3d linear_B_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_B_rad_s = Eigen::Vector3d::Zero();
};

/// twists[i] is that of RobotModel::links[i], which stands at pose.X_BL[i]. `velocities` has one
/// number for each of RobotModel::joints (rad/s, or m/s where prismatic). Reuses the memory of
/// `twists`. Throws std::invalid_argument where their number is wrong.
void link_twists(const RobotModel& model, const RobotPose& pose, std::span<const double> velocities,
                 std::vector<LinkTwist>& twists);

}  // namespace berth
