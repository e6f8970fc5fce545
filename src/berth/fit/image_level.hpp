// For watch/ and calibration/: images with fewer pixels, for the first steps of a fit.
#pragma once

#include <vector>

#include "berth/fit/calibration_data.hpp"

namespace berth {

/// A camera's frames with each `step`-th pixel of each `step`-th row.
struct ImageLevel {
  int step = 1;
  Camera camera;
  /// One for each frame.
  std::vector<DepthImage> depth_m;
};

ImageLevel make_level(const CalibrationCamera& camera, int step);

}  // namespace berth
