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

/// The frame in which the person is nearest.
constexpr std::size_t kFrame = 19;

/// The frame, and all that its stages made of it.
struct Example {
  std::shared_ptr<const Recording> recording =
      open_recording(std::filesystem::path(BERTH_BUNDLED_SCENE) / "scene.yaml", "bundled");
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
  repeat(state, [&] { brute_force(e.question(), e.distances); });
