// What methods that compare images are asked with, in one line.
#pragma once

#include <optional>

#include "thesis/settings.hpp"

namespace berth::testing {

inline ImageDistanceSettings image_settings(double range_m, bool mean_direction = true,
                                            std::optional<double> tolerance_m = {},
                                            std::optional<double> deadline_us = {}) {
  ImageDistanceSettings settings;
  settings.range_m = range_m;
  settings.mean_direction = mean_direction;
  settings.tolerance_m = tolerance_m;
  settings.deadline_us = deadline_us;
  return settings;
}

}  // namespace berth::testing
