// Calibration of a scene: all of it, as the command, and whoever else calibrates, does it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "berth/calibration/attached_parts.hpp"
#include "berth/calibration/detection_map.hpp"
#include "berth/calibration/filter_settings.hpp"
#include "berth/scene/rewrite_scene.hpp"
#include "berth/scene/scene_calibration.hpp"
#include "berth/watch/watch_settings.hpp"

namespace berth {

/// What the cameras of a scene detect where they were found, with the settings that were proposed.
/// With `corrects_depth` readings are taken as `found` corrects them.
DetectionMap measure_detection_of(const CalibrationData& calibration_data,
                                  const CalibrationResult& found,
                                  const std::vector<FilterProposal>& filters, bool corrects_depth,
                                  const std::function<void()>& pause);

/// What calibration is to find, and to change.
struct CalibrateSceneSettings {
  CalibrationSettings fit;
  /// Whether the depth error that was found is taken out of the readings from now on.
  bool correct_depth = false;
  /// Asked about each part that the robot carries and its URDF does not have, with the poses that
  /// were found: whether it is one. By default none is taken, since a thing of the room that is
  /// taken for the robot is never seen.
  std::function<bool(const AttachedPart&, const CalibrationResult&)> takes_part =
      [](const AttachedPart&, const CalibrationResult&) { return false; };
};

/// What calibration found of a scene.
struct SceneCalibration {
  CalibrationResult found;
  /// One for each camera, as below.
  std::vector<FilterProposal> filters;
  /// The normal readings of the camera, by which a bump is noticed.
  std::vector<WatchSettings> watches;
  /// What makes the result worse than it could be, in sentences.
  std::vector<std::string> warnings;
  /// What the robot carries. The settings of filters and watches are those for a robot with the
  /// parts that were taken.
  AttachedParts attached;
  /// What the cameras detect with those settings.
  DetectionMap detection;
  /// What to write into the scene file, but for the parts: attach_parts() adds them.
  SceneChange change;
};

/// Throws std::runtime_error that names file, camera and what was expected where nothing can be
/// calibrated: an arm that never moves, a camera whose images no pose explains.
SceneCalibration calibrate_scene(const OpenScene& scene, const SceneCalibrationData& material,
                                 const CalibrateSceneSettings& settings);

}  // namespace berth
