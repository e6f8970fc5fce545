#pragma once

#include <cstdint>

#include "thesis/closest_pair.hpp"
#include "thesis/image_request.hpp"
#include "thesis/search_pattern.hpp"

namespace berth {

/// What all searches around the robot pixels of one request have in common. The obstacle image has
/// the camera's size.
struct Surveillance {
  const Camera& camera;
  const Metric& metric;
  DepthView obstacle_depth_m;
  SurveillanceRegion region;
  DepthInterval depth_interval;
  SearchPattern search_pattern;
  Shrinking shrinking;
  /// No pair within the range: where nothing shrinks, L is its distance.
  ClosestPair none_yet;
};

/// Where the settings name no region, it is `usual_region`. The settings are valid.
Surveillance surveillance_of(const ImageRequest& request, const Metric& metric,
                             SurveillanceRegion usual_region);

/// Replaces `best` by the closest pair of the robot pixel and every step-th obstacle pixel of its
/// region of surveillance, where that is closer. Unless told otherwise, the region's L is the
/// distance of `best` and shrinks with it, after each run of the pattern (Hirt algorithm 2).
/// Returns the number of pairs computed: obstacle pixels visited that have a depth in the interval.
std::int64_t search_around(const Surveillance& surveillance, Pixel robot_pixel, float robot_depth_m,
                           PixelStep step, ClosestPair& best);

}  // namespace berth
