#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "berth/robot/robot_model.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// X_BL[i] is the pose of RobotModel::links[i] in the frame B of the root link.
struct RobotPose {
  std::vector<Pose> X_BL;
};

/// Writes to `pose`, whose memory it reuses. `positions` holds RobotModel::joints.size() finite
/// numbers in that order (rad, or m where prismatic); limits are not enforced, since a robot may
/// stand beyond them. Throws std::invalid_argument where their number is wrong or one is not
/// finite.
void forward_kinematics(const RobotModel& model, const std::vector<double>& positions,
                        RobotPose& pose);

/// How a point that is fixed to RobotModel::links[link], and lies at p_B_m now, moves in the root
/// link's frame B with each of RobotModel::joints: column j is its velocity in m/s where joint j
/// moves by 1 rad/s (or m/s) and the others stand still. Reuses the memory of `jacobian`.
void point_jacobian(const RobotModel& model, const RobotPose& pose, std::size_t link,
                    const Eigen::Vector3d& p_B_m, Eigen::Matrix3Xd& jacobian);

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

/// A joint that moves a link, or a link before it.
struct ChainJoint {
  /// The joint is that of RobotModel::links[link].
  std::size_t link = 0;
  /// A radian, or a metre, of it moves no point of the link farther.
  double reach_m = 0;
};

/// From RobotModel::links[link] itself to the root, fixed joints among them.
std::vector<ChainJoint> joint_chain(const RobotModel& model, std::size_t link);

/// Sets the reach of each joint of a chain: 1 where it slides, else the farthest that a point
/// within radius_m of the link's origin is from the joint's, however the joints between are turned.
/// They slide by at most slides_m from where they are, by RobotModel::joints; empty: not at all.
void find_reach(const RobotModel& model, const RobotPose& pose, double radius_m,
                std::span<const double> slides_m, std::span<ChainJoint> chain);

}  // namespace berth
