#include "lab/bench/bench.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lab/bench/compare.hpp"
#include "lab/bench/drawn_scenes.hpp"
#include "lab/bench/extent.hpp"
#include "lab/bench/gl_bench.hpp"
#include "lab/bench/recorded_scenes.hpp"
#include "lab/bench/report.hpp"
#include "lab/bench/stages.hpp"
#include "lab/bench/whole_robot.hpp"

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

/// In files of its own, so that it can be measured anew without the rest.
void run_whole_robot(const BenchSettings& settings, const BenchExtent& extent) {
  Report report(settings.out_folder, "", "whole_robot.md");
  for (const Table& table :
       measure_whole_robot(settings.bundled_scene, extent.whole_robot_scenes)) {
    report.add(table);
  }
  report.add(compare_whole_robot(settings.bundled_scene,
                                 std::min(extent.cameras_peer_scenes, extent.whole_robot_scenes)));
}

void run_image_methods(const BenchSettings& settings, const BenchExtent& extent) {
  Report report(settings.out_folder);
  const auto bundled = open_recording(settings.bundled_scene, "Bundled scene");
  std::vector<std::shared_ptr<const Recording>> recordings;
  for (const auto& file : settings.scenes)
    recordings.push_back(open_recording(file, recording_title(file)));

  report.add(compare_peers(random_scenes(extent.random_scenes), extent.limits, make_peers()));
  report.add(compare_peers(hard_scenes(extent.hard_scenes), extent.limits, make_peers()));
  measure_recording(bundled, extent, report);
  for (const auto& recording : recordings) measure_recording(recording, extent, report);
}

}  // namespace

void run_benchmarks(const BenchSettings& settings) {
  const BenchExtent extent =
      settings.quick ? kQuick : BenchExtent{settings.random_scenes, settings.whole_robot_scenes};
  if (settings.gl_device) {
    run_gl_benchmarks(settings, extent);
    return;
  }
  if (!settings.whole_robot_alone) run_image_methods(settings, extent);
  run_whole_robot(settings, extent);
}

}  // namespace berth::lab
