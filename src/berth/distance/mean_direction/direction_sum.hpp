// The inner loop of fill_mean_directions.
#pragma once

#include <vector>

#include "berth/distance/mean_direction/direction_blocks.hpp"
#include "berth/distance/metric.hpp"
#include "berth/types/image.hpp"

namespace berth {

/// The robot pixel that directions start from, and the sum of its directions to the obstacle pixels
/// of a rectangle that are no deeper than max_depth_m.
struct DirectionSum {
  float u;
  float v;
  float depth_m;
  float max_depth_m;
  PixelRect rect;
  /// The sum of unit vectors in frame C, and their number.
  double x = 0;
  double y = 0;
  double z = 0;
  double count = 0;
  /// A bound of the length of what the sum is wrong by.
  double error = 0;
  bool is_done = false;
};

/// Fills new sums with all obstacle pixels, without those at distance 0. The directions to the
/// pixels of a block far away are taken from its mean and covariance, as long as the mean of all
/// directions is wrong by max_error at most.
void sum_directions(const Metric& metric, DepthView obstacle_depth_m, const DirectionBlocks& blocks,
                    float max_error, DirectionSum* sums, int sum_count);

}  // namespace berth
