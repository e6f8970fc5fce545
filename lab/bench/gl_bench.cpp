#include "lab/bench/gl_bench.hpp"

#include "lab/bench/compare.hpp"
#include "lab/bench/drawn_scenes.hpp"
#include "lab/bench/gl_stages.hpp"
#include "lab/bench/recorded_scenes.hpp"
#include "lab/bench/report.hpp"
#include "thesis/opengl/gl_context.hpp"

namespace berth::lab {
namespace {

/// Those on OpenGL beside exact on one thread.
std::vector<std::unique_ptr<Peer>> make_peers_beside_exact() {
  std::vector<std::unique_ptr<Peer>> peers = make_gl_peers();
  peers.push_back(make_berth_exact());
  return peers;
}

}  // namespace

void run_gl_benchmarks(const BenchSettings& settings, const BenchExtent& extent) {
  GlContext context(*settings.gl_device);
  Report report(settings.out_folder, context.renderer());
  const auto compare = [&](const SceneSet& scenes) {
    report.add(compare_peers(scenes, extent.limits, make_peers_beside_exact()));
    context.check(scenes.title);
  };
  compare(random_scenes(extent.random_scenes));
  compare(hard_scenes(extent.hard_scenes));
  std::vector<std::shared_ptr<const Recording>> recordings = {
      open_recording(settings.bundled_scene, "Bundled scene")};
  for (const auto& file : settings.scenes) {
    recordings.push_back(open_recording(file, recording_title(file)));
  }
  for (const auto& recording : recordings) {
    compare(recorded_scenes(recording, extent.recorded_frames));
    report.add(measure_gl_stages(*recording, extent.recorded_frames, extent.stage_rounds));
    context.check(recording->title);
  }
}

}  // namespace berth::lab
