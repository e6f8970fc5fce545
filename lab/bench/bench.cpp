#include "lab/bench/bench.hpp"

#include <algorithm>

#include "lab/bench/compare.hpp"
#include "lab/bench/drawn_scenes.hpp"
#include "lab/bench/recorded_scenes.hpp"
#include "lab/bench/report.hpp"
#include "lab/bench/stages.hpp"
#include "lab/bench/whole_robot.hpp"
#include "thesis/opengl/gl_context.hpp"

namespace berth::lab {
namespace {

/// How much is measured.
struct BenchExtent {
  int random_scenes = 0;
  int whole_robot_scenes = 0;
  /// Of them, for the peers that take seconds.
  int cameras_peer_scenes = 10;
  int hard_scenes = kHardScenes;
  int recorded_frames = 12;
  int stage_rounds = 20;
  RunLimits limits = {};
};

/// In less than half a minute.
constexpr BenchExtent kQuick{2, 1, 1, 1, 1, 1, {3, 5, 50}};

using Peers = std::vector<std::unique_ptr<Peer>>;

/// All of the processor but brute_force, which is the measure of the others, and the reader.
Peers make_peers() {
  Peers peers;
  peers.push_back(make_berth_exact());
  for (auto& variant : make_berth_variants()) peers.push_back(std::move(variant));
  peers.push_back(make_nanoflann());
  peers.push_back(make_embree());
  peers.push_back(make_fcl_octomap(0.02));
  peers.push_back(make_fcl_octomap(0.01));
  return peers;
}

/// Those on OpenGL beside exact on one thread.
Peers make_peers_beside_exact() {
  Peers peers = make_gl_peers();
  peers.push_back(make_berth_exact());
  return peers;
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

/// The bundled scene first.
std::vector<std::shared_ptr<const Recording>> open_recordings(const BenchSettings& settings) {
  std::vector recordings{open_recording(settings.bundled_scene, "Bundled scene")};
  for (const auto& file : settings.scenes) {
    recordings.push_back(open_recording(file, recording_title(file)));
  }
  return recordings;
}

void run_image_methods(const BenchSettings& settings, const BenchExtent& extent) {
  Report report(settings.out_folder);
  const auto recordings = open_recordings(settings);
  report.add(compare_peers(random_scenes(extent.random_scenes), extent.limits, make_peers()));
  report.add(compare_peers(hard_scenes(extent.hard_scenes), extent.limits, make_peers()));
  for (const auto& recording : recordings) {
    report.add(compare_peers(recorded_scenes(recording, extent.recorded_frames), extent.limits,
                             make_peers()));
    for (const int threads : {1, 2}) {
      report.add(measure_stages(*recording, threads, extent.stage_rounds));
    }
  }
}

void run_gl_methods(const BenchSettings& settings, const BenchExtent& extent) {
  GlContext context(*settings.gl_device);
  Report report(settings.out_folder, context.renderer());
  const auto compare = [&](const SceneSet& scenes) {
    report.add(compare_peers(scenes, extent.limits, make_peers_beside_exact()));
    context.check(scenes.title);
  };
  compare(random_scenes(extent.random_scenes));
  compare(hard_scenes(extent.hard_scenes));
  for (const auto& recording : open_recordings(settings)) {
    compare(recorded_scenes(recording, extent.recorded_frames));
    report.add(measure_gl_stages(*recording, extent.recorded_frames, extent.stage_rounds));
    context.check(recording->title);
  }
}

}  // namespace

void run_benchmarks(const BenchSettings& settings) {
  const BenchExtent extent =
      settings.quick ? kQuick : BenchExtent{settings.random_scenes, settings.whole_robot_scenes};
  if (settings.gl_device) {
    run_gl_methods(settings, extent);
    return;
  }
  if (!settings.whole_robot_alone) run_image_methods(settings, extent);
  run_whole_robot(settings, extent);
}

}  // namespace berth::lab
