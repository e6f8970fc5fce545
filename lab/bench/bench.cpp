#include "lab/bench/bench.hpp"

#include <fmt/format.h>

#include "lab/bench/compare.hpp"
#include "lab/bench/drawn_scenes.hpp"
#include "lab/bench/extent.hpp"
#include "lab/bench/gl_bench.hpp"
#include "lab/bench/growth.hpp"
#include "lab/bench/recorded_scenes.hpp"
#include "lab/bench/report.hpp"
#include "lab/bench/stages.hpp"

namespace berth::lab {
namespace {

void measure_recording(const std::shared_ptr<const Recording>& recording, const BenchExtent& extent,
                       Report& report) {
  report.add(compare_peers(recorded_scenes(recording, extent.recorded_frames), extent.limits,
                           make_peers()));
  for (const int threads : {1, 2}) {
    report.add(measure_stages(*recording, threads, extent.stage_rounds));
  }
}

}  // namespace

void run_benchmarks(const BenchSettings& settings) {
  const BenchExtent extent = settings.quick ? kQuick : BenchExtent{settings.random_scenes};
  if (settings.gl_device) {
    run_gl_benchmarks(settings, extent);
    return;
  }
  Report report(settings.out_folder);
  const auto bundled = open_recording(settings.bundled_scene, "Bundled scene");
  std::vector<std::shared_ptr<const Recording>> recordings;
  for (const auto& file : settings.scenes)
    recordings.push_back(open_recording(file, recording_title(file)));

  report.add(compare_peers(random_scenes(extent.random_scenes), extent.limits, make_peers()));
  report.add(compare_peers(hard_scenes(extent.hard_scenes), extent.limits, make_peers()));
  report.add(compare_peers(bowl_scenes(extent.bowl_scenes), extent.limits, make_peers()));
  measure_recording(bundled, extent, report);
  for (const auto& recording : recordings) measure_recording(recording, extent, report);
  report.add(measure_growth_of_image(extent.growth_scenes, extent.limits));
  report.add(measure_growth_of_links(extent.growth_scenes, extent.limits));
  report.add(measure_growth_of_meshes(settings.bundled_scene, 10 * extent.stage_rounds));
}

}  // namespace berth::lab
