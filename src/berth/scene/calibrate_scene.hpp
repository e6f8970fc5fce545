// Calibration of a scene: all of it, as the command, and whoever else calibrates, does it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "berth/scene/rewrite_scene.hpp"
#include "berth/scene/scene_calibration.hpp"
#include "berth/watch/watch_settings.hpp"

namespace berth {

/// What calibration is to find, and to change.
struct CalibrateSceneSettings {
  CalibrationSettings fit;
  /// Whether the depth error that was found is taken out of the readings from now on.
  bool correct_depth = false;
};

/// What calibration found of a scene.
struct SceneCalibration {
  CalibrationResult found;
  /// One for each camera, as below.
  std::vector<FilterProposal> filters;
  /// What is normal for the camera, so that it is noticed when it is bumped.
  std::vector<WatchSettings> watches;
  /// What makes the result worse than it could be, in sentences.
  std::vector<std::string> warnings;
  /// What to write into the scene file.
  SceneChange change;
};

/// Throws std::runtime_error that names file, camera and what was expected where nothing can be
/// calibrated: an arm that never moves, a camera whose images no pose explains.
SceneCalibration calibrate_scene(const OpenScene& scene, const SceneCalibrationData& material,
                                 const CalibrateSceneSettings& settings);

}  // namespace berth
