// Inside calibration/ only.
#pragma once

#include <cstdint>

#include "berth/fit/fit.hpp"
#include "berth/fit/score.hpp"

namespace berth {

struct CoarseSearch {
  int step = 8;
  /// Readings this near to the model fit, in the first round; half of it in the next, and so on.
  double cut_m = 0.15;
  /// How far from the start the robot is looked for, before the camera.
  double reach_m = 0.25;
  double reach_rad = 0.35;
  int tries = 300;
  int rounds = 3;
  /// How many of the best are returned.
  int best = 6;
};

/// How many pixels and places of its outline the robot shows in most poses of a search: a pose that
/// shows much less of it has left the image.
Score typical_size(FrameDrawer& drawer, const CalibrationEstimate& start,
                   const CoarseSearch& search);

/// Poses of one camera, drawn around `start` and, round after round, more closely around the best:
/// the best of them first. Depends on its arguments alone.
std::vector<CalibrationEstimate> search_coarsely(FrameDrawer& drawer,
                                                 const CalibrationEstimate& start,
                                                 const CoarseSearch& search, double least_pixels);

}  // namespace berth
