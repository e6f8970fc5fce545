#pragma once

#include <Eigen/Core>

#include "berth/robot/kinematics.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth {

/// How a point that is fixed to RobotModel::links[link], and lies at p_B_m now, moves in the root
/// link's frame B with each of RobotModel::joints: column j is its velocity in m/s where joint j
/// moves by 1 rad/s (or m/s) and the others stand still. Reuses the memory of `jacobian`.
void point_jacobian(const RobotModel& model, const RobotPose& pose, std::size_t link,
                    const Eigen::Vector3d& p_B_m, Eigen::Matrix3Xd& jacobian);

}  // namespace berth
