#include "thesis/study/measurement.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lab/measure/stopwatch.hpp"

namespace berth::lab {
namespace {

constexpr int kLeastRuns = 3;
constexpr int kMostRuns = 20;
constexpr double kEnough_ms = 3;
constexpr double kOnceAbove_ms = 30;

std::string columns_of(const Spread& spread) {
  if (spread.count == 0) return ",,";
  return fmt::format("{:.5g},{:.5g},{:.5g}", spread.mean(), spread.deviation(), spread.greatest);
}

double time_once_ms(const ParameterSet& set, const sim::ImagePair& images,
                    MeasureWorkspace& workspace) {
  workspace.answer.links.clear();
  const Stopwatch watch(CLOCK_THREAD_CPUTIME_ID);
  if (set.method == Method::exact) {
    workspace.obstacles.build(images.obstacle_depth_m);
  } else {
    workspace.obstacles = SearchableDepth(images.obstacle_depth_m);
  }
  evaluate(set.method,
           {images.camera, images.robot, images.link_count, workspace.obstacles, set.settings},
           workspace.evaluate, workspace.answer);
  return watch.ms();
}

}  // namespace

std::string columns_of(const Measurement& measurement) {
  const LinkErrors& errors = measurement.errors;
  return fmt::format("{:.5g},{},{},{},{},{},{}", measurement.time_ms, measurement.pairs,
                     errors.links_in_range, errors.links_missed, columns_of(errors.distance_mm),
                     columns_of(errors.robot_point_mm), columns_of(errors.obstacle_point_mm));
}

double least_ms(const std::function<double()>& run_ms) {
  double time_ms = run_ms();
  double all_ms = time_ms;
  const auto is_enough = [&](int runs) {
    return time_ms > kOnceAbove_ms || runs == kMostRuns ||
           (runs >= kLeastRuns && all_ms >= kEnough_ms);
  };
  for (int runs = 1; !is_enough(runs); ++runs) {
    const double this_ms = run_ms();
    time_ms = std::min(time_ms, this_ms);
    all_ms += this_ms;
  }
  return time_ms;
}

Measurement measure(const ParameterSet& set, const sim::ImagePair& images,
                    const LinkDistances& truth, MeasureWorkspace& workspace) {
  Measurement found;
  found.time_ms = least_ms([&] { return time_once_ms(set, images, workspace); });
  found.pairs = workspace.answer.pairs;
  found.errors = errors_of(truth, workspace.answer, set.settings.range_m);
  return found;
}

}  // namespace berth::lab
