// Inside robot/ only.
#pragma once

#include "berth/robot/robot_model.hpp"

namespace berth {

/// Loads RobotSettings::others, roles not yet given, and appends their links and joints to the
/// model. Throws std::runtime_error as load_robot does.
void append_other_robots(const RobotSettings& settings, RobotModel& model);

/// Tree and shapes of the robot that the settings name, without others and roles.
RobotModel load_one_robot(const RobotSettings& settings);

}  // namespace berth
