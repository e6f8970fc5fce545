// Each stage of the pipeline on one frame of the bundled scene, for Google Benchmark: to judge a
// change of one of them. Whole tables are the business of `berth_bench`.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "berth/distance/brute_force.hpp"
#include "berth/distance/mean_direction/mean_direction.hpp"
#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/observer.hpp"
#include "lab/bench/recorded_scenes.hpp"

namespace {

using namespace berth;
using namespace berth::lab;

/// The frame in which the person is nearest.
constexpr std::size_t kFrame = 19;

/// The frame, and all that its stages made of it.
struct Example {
  std::shared_ptr<const Recording> recording =
      open_recording(std::filesystem::path(BERTH_BUNDLED_SCENE) / "one_camera.yaml", "bundled");
  const std::shared_ptr<const View>& view = recording->camera().view;
  const JointState& joints = recording->camera().at_exposure[kFrame];
  const JointState& other_joints = recording->camera().at_exposure[kFrame + 1];
  DepthImage depth_m = recording->camera().read_depth(kFrame);
  int links = view->robot()->model().link_count();
  DistanceSettings settings = view->robot()->settings().distance;
  RobotPose pose;
  Frame frame;
  EvaluateWorkspace workspace;
  LinkDistances distances;

  Example() {
    Observer(view).observe(depth_m, joints, frame);
    forward_kinematics(view->robot()->model(), joints.position, pose);
    settings.mean_direction = false;
    run_exact();
  }

  /// Without an answer to begin from.
  void run_exact() {
    distances.links.clear();
    exact(question(), workspace.exact, distances);
  }

  Question question() const {
    return {view->camera(), frame.robot, links, frame.searchable, settings};
  }
};

/// Runs with state.range(0) threads.
template <class Call>
void repeat(benchmark::State& state, Call call) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, state.range(0));
  for ([[maybe_unused]] auto _ : state) {
    call();
    benchmark::ClobberMemory();
  }
}

void kinematics(benchmark::State& state) {
  Example e;
  repeat(state, [&] { forward_kinematics(e.view->robot()->model(), e.joints.position, e.pose); });
}

void render(benchmark::State& state) {
  Example e;
  RobotRenderer renderer(e.view->robot()->meshes(), e.view->camera());
  repeat(state, [&] { renderer.render(e.pose, e.frame.X_BC, e.frame.robot); });
}

void filter(benchmark::State& state) {
  Example e;
  SelfFilterWorkspace workspace;
  repeat(state, [&] {
    self_filter(e.view->camera(), e.depth_m, e.frame.robot, e.view->settings().self_filter, workspace,
                e.frame.obstacles);
  });
}

void obstacle_tree(benchmark::State& state) {
  Example e;
  repeat(state, [&] { e.frame.searchable.build(e.frame.obstacles.depth_m); });
}

void robot_tiles(benchmark::State& state) {
  Example e;
  RobotTiles tiles;
  repeat(state, [&] { build_robot_tiles(e.frame.robot, e.links, tiles); });
}

void exact_search(benchmark::State& state) {
  Example e;
  repeat(state, [&] { e.run_exact(); });
}

void mean_direction(benchmark::State& state) {
  Example e;
  repeat(state, [&] { fill_mean_directions(e.question(), e.workspace.directions, e.distances); });
}

void visibility(benchmark::State& state) {
  Example e;
  const SamplePoints points = sample_points(e.view->robot()->model());
  const SeenFrame seen{e.view->camera(), e.frame.robot, e.frame.obstacles,
                       tolerance_of(e.view->settings().self_filter)};
  VisibilityWorkspace workspace;
  std::vector<LinkVisibility> links;
  repeat(state, [&] {
    find_visibility(e.view->robot()->model(), points, seen, {e.pose, e.frame.X_BC, e.frame.robot}, e.distances,
                    e.settings.range_m, workspace, links);
  });
}

void all_pairs(benchmark::State& state) {
  Example e;
  repeat(state, [&] { brute_force(e.question(), e.distances); });
}

void depth_image_to_result(benchmark::State& state) {
  Example e;
  Observer observer(e.view);
  Asker asker(e.view->robot());
  repeat(state, [&] {
    observer.observe(e.depth_m, e.joints, e.frame);
    asker.ask(e.frame);
  });
}

void question_at_new_joints(benchmark::State& state) {
  Example e;
  Asker asker(e.view->robot());
  repeat(state, [&] { asker.ask(e.frame, e.other_joints); });
}

BENCHMARK(kinematics)->Arg(1);
BENCHMARK(render)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(filter)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(obstacle_tree)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(robot_tiles)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK(exact_search)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(mean_direction)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(visibility)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK(all_pairs)->Arg(1)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(depth_image_to_result)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(question_at_new_joints)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
