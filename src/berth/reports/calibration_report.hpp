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

/// The calibration for people: of each camera how far its view moved and how sure that is,
/// residuals before and after, clock, depth, the proposed settings and why, and what to do next.
/// Draws the robot into all frames.
std::string calibration_table(const CalibrationReport& report);

/// The calibration as one line of JSON, schema berth/calibration/1, without a line break at its
/// end. Metres, seconds, radians and pixels, rounded to a millionth, quaternions to a thousandth of
/// that. What is not known is null: deviations of a pose that was refused, that of a clock that is
/// not determined, the comparison of halves with one frame, residuals of a robot that is not seen.
std::string calibration_json(const CalibrationReport& report);

/// What calibration_json() writes, schema berth/calibration/1, as JSON Schema (draft 2020-12), in
/// lines.
std::string calibration_schema();

}  // namespace berth
