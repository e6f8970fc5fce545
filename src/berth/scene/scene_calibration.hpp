// A scene as material for a calibration.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "berth/calibration/calibrate.hpp"
#include "berth/calibration/filter_settings.hpp"
#include "berth/fit/calibration_data.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth {

/// Frames of each camera that show the robot in poses as different as possible.
struct SceneCalibrationData {
  /// One for each camera of the scene; calibration_data refers to them.
  std::vector<std::unique_ptr<CalibrationCamera>> cameras;
  CalibrationData calibration_data;
  /// What makes the result worse than it could be, in sentences.
  std::vector<std::string> warnings;
};

/// read_scene() of a scene that is asked no request: nothing is made ready for one.
SceneFile read_scene_to_calibrate(const std::filesystem::path& file);

/// More frames than this of a camera tell nothing new.
inline constexpr std::size_t kMostCalibrationFrames = 20;

/// The scene has to outlive it. Throws std::runtime_error that names camera and place where the arm
/// stands still in all frames of a camera, or none of them has joint angles.
SceneCalibrationData make_calibration_data(const OpenScene& scene);

}  // namespace berth
