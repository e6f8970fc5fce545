// The scene that `berth init` writes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "berth/robot/robot_model.hpp"

namespace berth::app {

/// The names of camera_kinds(), in their order.
std::vector<std::string> camera_kind_names();

/// What a new scene is made from.
struct NewScene {
  RobotSettings robot;
  /// One of camera_kind_names().
  std::string camera;
  /// Paths in the text are relative to its folder.
  std::filesystem::path out;
  /// The JSON Schema of scene files, for editors.
  std::filesystem::path schema;
};

/// Links that no joint moves and that carry none of those that one does: what the robot stands on
/// and beside, where the URDF has it. Those with geometry, by name.
std::vector<std::string> likely_environment(const RobotModel& model);

/// A scene file with a comment for each thing that its user has to fill in. `model` is that of
/// scene.robot.
std::string new_scene_text(const NewScene& scene, const RobotModel& model);

}  // namespace berth::app
