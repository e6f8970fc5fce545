// For watch/ and calibration/.
#pragma once

#include <vector>

#include "berth/fit/depth_rows.hpp"
#include "berth/fit/estimate.hpp"
#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

struct OutlineRowLimits {
  /// How far the sensor's outline is looked for, on both sides of the model's.
  int reach_px = 10;
  /// A reading is like the robot where it differs from the model's depth by no more than this.
  double band_m = 0.05;
};

/// What was found at the model's outline.
struct OutlineCount {
  /// Places where the model's outline stands before nothing, or before something far behind it.
  int places = 0;
  /// Those where the sensor's outline was found.
  int found = 0;
};

/// One row for each place of the model's outline where the sensor's was found: the way between
/// both, across the outline, in metres at the model's depth. Appends to `rows`. `step` is how many
/// pixels of the sensor one of these images stands for.
OutlineCount append_outline_rows(const Camera& camera, DepthView depth_m, const RobotImage& robot,
                                 const CameraEstimate& estimate, int step,
                                 const OutlineRowLimits& limits, std::vector<FitRow>& rows);

}  // namespace berth
