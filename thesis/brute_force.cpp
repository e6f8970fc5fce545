#include "thesis/brute_force.hpp"

#include <cassert>
#include <cmath>

#include "thesis/closest_pair.hpp"
#include "thesis/surveillance.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "thesis/brute_force.cpp"
#include "hwy/foreach_target.h"

#include "thesis/metric_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// The least D^2 of a robot pixel and the obstacle pixels of one row; +inf if there are none.
float least_in_row_m2(const Metric& metric, float ru, float rv, float robot_depth_m, float ov,
                      const float* obstacle_depth_m, int width) {
  const BasicMetric<Lanes> metrics = broadcast(metric);
  Lanes least_m2(HUGE_VALF);
  for (int u = 0; u < width; u += kLanes) {
    const Lanes squared_m2 = squared_distance_m2(
        metrics, Lanes(ru), Lanes(rv), Lanes(robot_depth_m), count_up(static_cast<float>(u)),
        Lanes(ov), load_first(obstacle_depth_m + u, width - u));
    least_m2 = lesser_or_first(least_m2, squared_m2);
  }
  return least_lane(least_m2);
}

/// Tries the robot pixel (ru, rv) against every obstacle pixel.
void try_robot_pixel(const Metric& metric, float ru, float rv, float robot_depth_m,
                     const DepthView& obstacle_depth_m, ClosestPair& best) {
  for (int v = 0; v < obstacle_depth_m.height; ++v) {
    const auto ov = static_cast<float>(v);
    const float* row_m = obstacle_depth_m.row(v);
    const float least_m2 =
        least_in_row_m2(metric, ru, rv, robot_depth_m, ov, row_m, obstacle_depth_m.width);
    if (!(least_m2 < best.squared_m2)) continue;
    int u = 0;
    while (berth::squared_distance_m2(metric, ru, rv, robot_depth_m, static_cast<float>(u), ov,
                                      row_m[u]) != least_m2) {
      ++u;
    }
    best = {least_m2, ru, rv, robot_depth_m, static_cast<float>(u), ov, row_m[u]};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(try_robot_pixel);

namespace {

std::int64_t count_readings(DepthView depth_m) {
  std::int64_t count = 0;
  for (int v = 0; v < depth_m.height; ++v) {
    for (int u = 0; u < depth_m.width; ++u) count += !std::isnan(depth_m(u, v));
  }
  return count;
}

bool loses_pairs(const Surveillance& surveillance) {
  return surveillance.region == SurveillanceRegion::flacco ||
         surveillance.depth_interval == DepthInterval::cube;
}

}  // namespace

void brute_force(const ImageRequest& request, LinkDistances& out) {
  validate(request.settings);
  const RobotImage& robot = request.robot;
  const DepthView obstacle_depth_m = request.obstacles.depth_m();
  const int link_count = request.link_count;
  assert(robot.depth_m.width() == obstacle_depth_m.width);
  assert(robot.depth_m.height() == obstacle_depth_m.height);
  const Metric metric = metric_of(request.camera);
  const Surveillance surveillance = surveillance_of(request, metric, SurveillanceRegion::image);
  const bool tries_all = surveillance.region == SurveillanceRegion::image &&
                         surveillance.depth_interval == DepthInterval::gray_area;
  const std::int64_t readings = count_readings(obstacle_depth_m);
  const auto try_pixel = [&](Pixel pixel, ClosestPair& best) -> std::int64_t {
    const float depth_m = robot.depth_m(pixel.u, pixel.v);
    if (!tries_all) return search_around(surveillance, pixel, depth_m, {1, 1}, best);
    HWY_DYNAMIC_DISPATCH(try_robot_pixel)
    (metric, static_cast<float>(pixel.u), static_cast<float>(pixel.v), depth_m, obstacle_depth_m,
     best);
    return readings;
  };

  const auto range_m = static_cast<float>(request.settings.range_m);
  std::vector<ClosestPair> best(link_count, no_pair_within(range_m));
  std::vector<int> pixels(link_count, 0);
  out.pairs = 0;
  for (int v = 0; v < robot.depth_m.height(); ++v) {
    for (int u = 0; u < robot.depth_m.width(); ++u) {
      const LinkId id = robot.link_id(u, v);
      if (id == kNoLink || id == kEnvironmentLink) continue;
      assert(id <= link_count);
      ++pixels[id - 1];
      out.pairs += try_pixel({u, v}, best[id - 1]);
    }
  }
  out.links.resize(link_count);
  for (int i = 0; i < link_count; ++i) {
    out.links[i] = link_distance(static_cast<LinkId>(i + 1), pixels[i], metric, best[i], range_m);
    if (loses_pairs(surveillance) && pixels[i] > 0) out.links[i].lower_bound_m = 0;
  }
}

}  // namespace berth
#endif  // HWY_ONCE
