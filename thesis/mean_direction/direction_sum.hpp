// The inner loop of fill_mean_directions.
#pragma once

#include <cstdint>

#include "thesis/mean_direction/tile_means.hpp"
#include "thesis/metric.hpp"

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
  std::int64_t count = 0;
};

/// Adds the directions to all obstacle pixels but those at distance 0. A tile stands for its pixels
/// where a ball around them has a radius of at most kFarTile times the distance of their mean: then
/// the mean of their directions is that of their mean but for kMeanDirectionError.
void add_directions(const Metric& metric, const SearchableDepth& obstacles, const TileMeans& means,
                    DirectionSum& sum);

}  // namespace berth
