#include "thesis/surveillance.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

#include "thesis/region_of_surveillance.hpp"
#include "thesis/surveillance_run.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "thesis/surveillance.cpp"
#include "hwy/foreach_target.h"

#include "thesis/metric_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// Depths i, i + 1, ... of the run; NaN beyond its end.
HWY_INLINE Lanes load_run(const DepthRun& run, int i) {
  const float* x = run.depth_m + i * run.stride;
  if (run.stride == 1) return load_first(x, run.count - i);
  if (run.count - i >= kLanes) {
    const hn::RebindToSigned<FloatTag> index_tag;
    const auto stride = hn::Set(index_tag, static_cast<std::int32_t>(run.stride));
    return hn::GatherIndex(FloatTag(), x, hn::Mul(hn::Iota(index_tag, 0), stride));
  }
  alignas(64) float padded[kLanes];
  for (int k = 0; k < kLanes; ++k) padded[k] = i + k < run.count ? x[k * run.stride] : kNoDepth;
  return load(padded);
}

LeastOfRun least_of_run(const Metric& metric, const WatchedPixel& robot, const DepthRun& run) {
  const BasicMetric<Lanes> metrics = broadcast(metric);
  Lanes least_m2(HUGE_VALF);
  std::size_t pairs = 0;
  for (int i = 0; i < run.count; i += kLanes) {
    const Lanes depth_m = load_run(run, i);
    const auto counts = hn::And(hn::Ge(depth_m.v, Lanes(robot.depth_lo_m).v),
                                hn::Le(depth_m.v, Lanes(robot.depth_hi_m).v));
    if (hn::AllFalse(FloatTag(), counts)) continue;
    pairs += hn::CountTrue(FloatTag(), counts);
    const Lanes number = count_up(static_cast<float>(i));
    const Lanes squared_m2 = squared_distance_m2(
        metrics, Lanes(robot.u), Lanes(robot.v), Lanes(robot.depth_m),
        Lanes(run.u) + number * Lanes(run.du), Lanes(run.v) + number * Lanes(run.dv),
        Lanes(hn::IfThenElse(counts, depth_m.v, Lanes(kNoDepth).v)));
    least_m2 = lesser_or_first(least_m2, squared_m2);
  }
  return {least_lane(least_m2), static_cast<int>(pairs)};
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(least_of_run);

namespace {

struct Region {
  PixelRect rect;
  float depth_lo_m;
  float depth_hi_m;
};

/// The region whose L is a little more than the distance of the pair: the metric rounds, and what
/// is closer must lie inside.
Region region_within(const Surveillance& surveillance, Pixel robot_pixel, float robot_depth_m,
                     const ClosestPair& pair) {
  const double range_m = std::sqrt(static_cast<double>(pair.squared_m2)) * (1 + 1e-5);
  const bool is_cube = surveillance.depth_interval == DepthInterval::cube;
  return {region_of_surveillance(surveillance.region, surveillance.camera, robot_pixel,
                                 robot_depth_m, range_m),
          is_cube ? static_cast<float>(robot_depth_m - range_m)
                  : -std::numeric_limits<float>::infinity(),
          static_cast<float>(robot_depth_m + range_m)};
}

DepthRun depths_of(const DepthView& depth_m, const PixelRun& run) {
  return {static_cast<float>(run.u),
          static_cast<float>(run.v),
          static_cast<float>(run.du),
          static_cast<float>(run.dv),
          depth_m.row(run.v) + run.u,
          run.du + run.dv * depth_m.stride,
          run.count};
}

/// The first pair of the run with this distance.
ClosestPair pair_at(const Metric& metric, const WatchedPixel& robot, const DepthRun& run,
                    float squared_m2) {
  for (int i = 0;; ++i) {
    const float depth_m = run.depth_m[i * run.stride];
    if (!(depth_m >= robot.depth_lo_m && depth_m <= robot.depth_hi_m)) continue;
    const float u = run.u + static_cast<float>(i) * run.du;
    const float v = run.v + static_cast<float>(i) * run.dv;
    if (squared_distance_m2(metric, robot.u, robot.v, robot.depth_m, u, v, depth_m) == squared_m2) {
      return {squared_m2, robot.u, robot.v, robot.depth_m, u, v, depth_m};
    }
  }
}

}  // namespace

Surveillance surveillance_of(const ImageRequest& request, const Metric& metric,
                             SurveillanceRegion usual_region) {
  const SurveillanceSettings& watched = request.settings.surveillance;
  return {request.camera,
          metric,
          request.obstacles.depth_m(),
          watched.region.value_or(usual_region),
          watched.depth_interval,
          watched.search_pattern,
          watched.shrinking,
          no_pair_within(static_cast<float>(request.settings.range_m))};
}

std::int64_t search_around(const Surveillance& surveillance, Pixel robot_pixel, float robot_depth_m,
                           PixelStep step, ClosestPair& best) {
  const bool shrinks = surveillance.shrinking == Shrinking::per_link;
  if (shrinks && best.squared_m2 == 0) return 0;
  const auto least = HWY_DYNAMIC_DISPATCH(least_of_run);
  std::int64_t pairs = 0;
  Region region = region_within(surveillance, robot_pixel, robot_depth_m,
                                shrinks ? best : surveillance.none_yet);
  visit_runs(surveillance.search_pattern, robot_pixel, step, region.rect,
             [&](const PixelRun& pixels) {
               if (pixels.count == 0) return;
               const WatchedPixel robot{static_cast<float>(robot_pixel.u),
                                        static_cast<float>(robot_pixel.v), robot_depth_m,
                                        region.depth_lo_m, region.depth_hi_m};
               const DepthRun run = depths_of(surveillance.obstacle_depth_m, pixels);
               const LeastOfRun found = least(surveillance.metric, robot, run);
               pairs += found.pairs;
               if (!(found.squared_m2 < best.squared_m2)) return;
               best = pair_at(surveillance.metric, robot, run, found.squared_m2);
               if (shrinks) {
                 region = region_within(surveillance, robot_pixel, robot_depth_m, best);
               }
             });
  return pairs;
}

}  // namespace berth
#endif  // HWY_ONCE
