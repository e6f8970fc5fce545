#pragma once

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

}  // namespace berth
