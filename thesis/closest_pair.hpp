#pragma once

#include "thesis/link_distance.hpp"
#include "thesis/metric.hpp"

namespace berth {

/// The closest pair of a link so far. Whole pixel coordinates, as the metric takes them.
struct ClosestPair {
  float squared_m2;
  float ru = -1;
  float rv = -1;
  float robot_depth_m = kNoDepth;
  float ou = -1;
  float ov = -1;
  float obstacle_depth_m = kNoDepth;
};

/// No pair, and the squared distance that a pair must fall below: a little more than range_m^2, so
/// that the comparison D <= L is made once, in link_distance().
ClosestPair no_pair_within(float range_m);

/// A link's answer from its closest pair, for a search that left nothing out. `robot_pixels` is the
/// number of its pixels in the robot image.
LinkDistance link_distance(LinkId id, int robot_pixels, const Metric& metric,
                           const ClosestPair& pair, float range_m);

}  // namespace berth
