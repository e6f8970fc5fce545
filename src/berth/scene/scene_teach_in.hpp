// A scene as material for a teach-in.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "berth/calibration/calibrate.hpp"
#include "berth/calibration/filter_settings.hpp"
#include "berth/calibration/teach_in.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth {

/// Frames of each camera that show the robot in poses as different as possible.
struct SceneTeachIn {
  /// One for each camera of the scene; teach_in refers to them.
  std::vector<std::unique_ptr<TeachInCamera>> cameras;
  TeachIn teach_in;
  /// What makes the result worse than it could be, in sentences.
  std::vector<std::string> warnings;
};

/// read_scene() of a scene that is asked no question: nothing is made ready for one.
SceneFile read_scene_to_teach(const std::filesystem::path& file);

/// More frames than this of a camera tell nothing new.
inline constexpr std::size_t kMostTeachInFrames = 20;

/// The scene has to outlive it. Throws std::runtime_error that names camera and place where the arm
/// stands still in all frames of a camera, or none of them has joint angles.
SceneTeachIn make_teach_in(const OpenScene& scene);

}  // namespace berth
