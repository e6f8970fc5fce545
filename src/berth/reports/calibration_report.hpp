// All that is known after a calibration, for those who tell people and programs of it.
#pragma once

#include <string>
#include <vector>

#include "berth/calibration/attached_parts.hpp"
#include "berth/calibration/calibrate.hpp"
#include "berth/calibration/detection_map.hpp"
#include "berth/calibration/filter_settings.hpp"
#include "berth/fit/calibration_data.hpp"
#include "berth/scene/calibrate_scene.hpp"

namespace berth {

struct CalibrationReport {
  /// What it started from. Not owned, never null.
  const CalibrationData* calibration_data = nullptr;
  /// What was found. Not owned, never null; as many cameras as in the calibration.
  const CalibrationResult* result = nullptr;
  /// One for each camera, in their order.
  std::vector<FilterProposal> proposals;
  /// Whether the new scene takes the depth's error out.
  bool corrects_depth = false;
  /// What the user should know before trusting the result, such as too few poses; each a sentence.
  std::vector<std::string> warnings;
  /// What the robot carries.
  AttachedParts attached = {};
  /// What the cameras detect with the proposed settings; empty where nobody measured it.
  DetectionMap detection = {};
};

/// Of a scene that was calibrated: it points into `material` and `calibration`, which have to
/// outlive it.
CalibrationReport report_of(const SceneCalibrationData& material,
                            const SceneCalibration& calibration, bool corrects_depth);

/// Images of all cameras that were used.
int frames_used(const CalibrationReport& report);

}  // namespace berth
