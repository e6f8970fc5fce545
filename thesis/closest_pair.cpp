#include "thesis/closest_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berth {
namespace {

Pixel pixel_of(float u, float v) { return {static_cast<int>(u), static_cast<int>(v)}; }

}  // namespace

ClosestPair no_pair_within(float range_m) {
  // Eight roundings above range_m^2: the square root of a float above it may still round to
  // range_m. Above 0 where range_m^2 underflows, since contact is always in range.
  return {std::max(range_m * range_m * (1 + 8 * std::numeric_limits<float>::epsilon()),
                   std::numeric_limits<float>::min())};
}

LinkDistance link_distance(LinkId id, int robot_pixels, const Metric& metric,
                           const ClosestPair& pair, float range_m) {
  LinkDistance link;
  link.id = id;
  link.robot_pixels = robot_pixels;
  if (robot_pixels == 0) return link;
  link.status = LinkStatus::none_in_range;
  link.lower_bound_m = range_m;
  const float distance_m = std::sqrt(pair.squared_m2);
  if (pair.ru < 0 || distance_m > range_m) return link;

  link.status = LinkStatus::ok;
  link.distance_m = distance_m;
  link.lower_bound_m = distance_m;
  link.robot_pixel = pixel_of(pair.ru, pair.rv);
  link.obstacle_pixel = pixel_of(pair.ou, pair.ov);
  const PairPoints points = pair_points(metric, pair.ru, pair.rv, pair.robot_depth_m, pair.ou,
                                        pair.ov, pair.obstacle_depth_m);
  link.robot_point_C_m = points.robot_C_m;
  link.obstacle_point_C_m = points.obstacle_C_m;
  return link;
}

}  // namespace berth
