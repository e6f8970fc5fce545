// Inside calibration/ only.
#pragma once

#include <cstdint>

#include "berth/calibration/fit.hpp"

namespace berth {

struct CoarseSearch {
  int step = 8;
  /// How far from the start the robot is looked for, before the camera.
  double reach_m = 0.3;
  double reach_rad = 0.35;
  int tries = 400;
  int rounds = 3;
  /// So many of the best are fitted.
  int fitted = 6;
};

/// Poses of one camera, drawn around `start` and, round after round, more closely around the best:
/// the best of them first. Depends on its arguments alone.
std::vector<CalibrationEstimate> search_coarsely(FrameDrawer& drawer, const CalibrationEstimate& start,
                                      const CoarseSearch& search);

}  // namespace berth
