#pragma once

#include <filesystem>
#include <string>

#include "berth/robot/robot_model.hpp"

namespace berth_ros {

/// Loads a URDF that came as a message: package://NAME/ means the share folder of the ROS package
/// NAME, but for those that `settings` name. Throws std::runtime_error as load_robot does.
berth::RobotModel load_description(const std::string& urdf, berth::RobotSettings settings);

/// The same for settings.urdf, a file.
berth::RobotModel load_urdf_file(berth::RobotSettings settings);

/// The file of a mesh: package://NAME/..., file://... or a path. Throws std::runtime_error where
/// nobody knows the package.
std::filesystem::path mesh_file_of(const std::string& resource);

}  // namespace berth_ros
