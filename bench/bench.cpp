#include "bench/bench.hpp"

#include <fmt/format.h>

#include "bench/compare.hpp"
#include "bench/drawn_scenes.hpp"
#include "bench/growth.hpp"
#include "bench/recorded_scenes.hpp"
#include "bench/report.hpp"
#include "bench/stages.hpp"

namespace berth::bench {
namespace {

/// How much is measured.
struct Extent {
  int random_scenes = 0;
  int hard_scenes = kHardScenes;
  int bowl_scenes = kBowlScenes;
  int recorded_frames = 12;
  int growth_scenes = 40;
  int stage_rounds = 20;
  RunLimits limits = {};
};

constexpr Extent kQuick{2, 1, 1, 1, 2, 1, {3, 5, 50}};

void measure_recording(const std::shared_ptr<const Recording>& recording, const Extent& extent,
                       Report& report) {
  report.add(compare_peers(recorded_scenes(recording, extent.recorded_frames), extent.limits));
  for (const int threads : {1, 2}) {
    report.add(measure_stages(*recording, threads, extent.stage_rounds));
  }
}

}  // namespace

void run_benchmarks(const BenchSettings& settings) {
  const Extent extent = settings.quick ? kQuick : Extent{settings.random_scenes};
  Report report(settings.out_folder);
  const auto bundled = open_recording(settings.bundled_scene, "Bundled scene");
  std::vector<std::shared_ptr<const Recording>> recordings;
  for (const auto& file : settings.scenes)
    recordings.push_back(open_recording(file, recording_title(file)));

  report.add(compare_peers(random_scenes(extent.random_scenes), extent.limits));
  report.add(compare_peers(hard_scenes(extent.hard_scenes), extent.limits));
  report.add(compare_peers(bowl_scenes(extent.bowl_scenes), extent.limits));
  measure_recording(bundled, extent, report);
  for (const auto& recording : recordings) measure_recording(recording, extent, report);
  report.add(measure_growth_of_image(extent.growth_scenes, extent.limits));
  report.add(measure_growth_of_links(extent.growth_scenes, extent.limits));
  report.add(measure_growth_of_meshes(settings.bundled_scene, 10 * extent.stage_rounds));
}

}  // namespace berth::bench
