// The inner loop of fill_mean_directions.
#pragma once

#include "berth/distance/metric.hpp"
#include "berth/types/image.hpp"

namespace berth {

/// The robot pixel that directions start from; obstacle pixels deeper than max_depth_m do not
/// count.
struct DirectionStart {
  float u;
  float v;
  float depth_m;
  float max_depth_m;
};

/// The sum of unit vectors in frame C, and their number.
struct DirectionSum {
  double x = 0;
  double y = 0;
  double z = 0;
  double count = 0;
};

/// Sums the directions to all obstacle pixels of a rectangle, without those at distance 0.
DirectionSum sum_directions(const Metric& metric, const DirectionStart& start,
                            DepthView obstacle_depth_m, PixelRect rect);

}  // namespace berth
