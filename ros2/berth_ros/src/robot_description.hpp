#pragma once

#include <string>

#include "berth/robot/robot_model.hpp"

namespace berth_ros {

/// Loads a URDF that came as a message: package://NAME/ means the share folder of the ROS package
/// NAME, but for those that `settings` name. Throws std::runtime_error as load_robot does.
berth::RobotModel load_description(const std::string& urdf, berth::RobotSettings settings);

/// The same for settings.urdf, a file.
berth::RobotModel load_urdf_file(berth::RobotSettings settings);

}  // namespace berth_ros
