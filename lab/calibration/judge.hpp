// What a calibration is worth on a real recording whose distances or masks are known.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "berth/calibration/calibrate.hpp"
#include "berth/calibration/filter_settings.hpp"
#include "berth/scene/scene_file.hpp"

namespace berth::lab {

/// What calibration makes of a scene, and the settings that it proposes for its first camera.
struct Calibrated {
  CalibrationResult found;
  FilterProposal proposal;
  /// Of the calibration alone.
  double time_s = 0;
};
Calibrated calibration_data(const SceneFile& file);

/// The scene with what was found of its first cameras, and with the filters proposed for each.
SceneFile with_result(SceneFile scene, const CalibrationResult& found,
                      std::span<const FilterProposal> filters);
/// The same of its first camera.
SceneFile with_result(SceneFile scene, const Calibrated& calibrated);

/// How far robot points so deep before the camera lie apart for two of its poses: in the mean over
/// a square of 60 cm.
double apart_m(const Pose& X_PC, const Pose& X_PC_other, double depth_m);

/// Counts over all frames and links of a recording: expected.tsv, and reference/robot_mask_*.png
/// where that is of the depth image's size; what there is of both.
struct Judgement {
  int checked = 0;
  int checked_in_range = 0;
  int estimates = 0;
  int estimates_in_range = 0;
  /// By more than 1 cm.
  int too_far = 0;
  /// Pixels of the masks, which show the robot in the colour image, that stay obstacles.
  int mask_pixels = 0;
  int mask_pixels_left = 0;
  /// Those of them that lie within 10 cm of the depth of a robot pixel near them.
  int robot_pixels_left = 0;
};
Judgement judge(const SceneFile& scene, const std::filesystem::path& folder);

/// Such as "27 of 27 checked in range, 0 too far, ...".
std::string text_of(const Judgement& judgement);

}  // namespace berth::lab
