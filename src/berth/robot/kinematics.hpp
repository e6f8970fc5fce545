#pragma once

#include <Eigen/Core>
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

}  // namespace berth
