// For watch/ and calibration/.
#pragma once

#include <vector>

#include "berth/fit/estimate.hpp"
#include "berth/fit/fit_row.hpp"
#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Which readings count as the robot's.
struct DepthRowLimits {
  /// Every Nth pixel of every Nth row.
  int stride = 1;
  /// Readings farther from the model than this, along the optical axis, are passed over.
  double cut_m = 0.03;
};

/// One row for each reading that may be the robot's: its way to the model's surface, along the
/// surface's normal. Appends to `rows`. Surfaces that are seen at a grazing angle are left out.
void append_depth_rows(const Camera& camera, DepthView depth_m, const RobotImage& robot,
                       const CameraEstimate& estimate, const DepthRowLimits& limits,
                       std::vector<FitRow>& rows);

}  // namespace berth
