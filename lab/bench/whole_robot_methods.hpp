// `exact` and `mesh` on drawn scenes, stage by stage, for whoever times them.
#pragma once

#include <algorithm>
#include <array>
#include <ctime>
#include <limits>

#include "apps/support/interrupt.hpp"
#include "apps/support/progress_bar.hpp"
#include "berth/distance/mesh_distances.hpp"
#include "lab/bench/whole_robot_scene.hpp"
#include "lab/measure/stopwatch.hpp"
#include "thesis/exact/exact.hpp"

namespace berth::lab {

/// The least time of three runs of `work`, each after `prepare`, which is not timed.
template <class Prepare, class Work>
double least_ms(clockid_t clock, Prepare prepare, Work work) {
  constexpr int kRuns = 3;
  double least_ms = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRuns; ++i) {
    prepare();
    const Stopwatch watch(clock);
    work();
    least_ms = std::min(least_ms, watch.ms());
  }
  return least_ms;
}

/// The yardstick: the search of `exact` in the images of the first camera, cold, without its tree.
class ExactYardstick {
 public:
  /// Processor time of this thread.
  double ms(const WholeRobotScene& scene, int links);

 private:
  SearchableDepth searchable_;
  ExactWorkspace workspace_;
  LinkDistances distances_;
};

/// What the cameras of one scene left.
class SceneSpaces {
 public:
  void build_view(const WholeRobotScene& scene, int k);
  void build_all(const WholeRobotScene& scene);
  /// Begins with the first `cameras` views anew: nobody has asked them yet.
  void assign(const WholeRobotScene& scene, int cameras);

  const UnknownSpace& hidden() const { return hidden_; }

 private:
  std::array<CameraSpace, kSceneCameras> spaces_;
  std::vector<PosedSpace> posed_;
  UnknownSpace hidden_;
};

/// Requests of method `mesh`.
class MeshMethod {
 public:
  explicit MeshMethod(const RobotModel& model) : robot_(build_robot_patches(model)) {}

  /// Without the last answer to begin with.
  void ask(const SceneSpaces& spaces, const RobotPose& pose, const MeshRequest& request = {});
  /// As a robot in motion does.
  void ask_on(const SceneSpaces& spaces, const RobotPose& pose, const MeshRequest& request);
  const std::vector<WholeLinkDistance>& distances() const { return distances_; }

 private:
  std::shared_ptr<const RobotPatches> robot_;
  MeshWorkspace workspace_;
  std::vector<WholeLinkDistance> distances_;
};

/// Runs each of `measures` on each scene, which is large and made once.
template <class... Measures>
void run_scenes(const std::string& title, const WholeRobotScenes& scenes, int count,
                Measures&... measures) {
  app::ProgressBar progress(title, count);
  for (int seed = 0; seed < count; ++seed) {
    app::stop_if_interrupted();
    const WholeRobotScene scene = scenes.draw(static_cast<std::uint32_t>(seed));
    (measures.run(scene), ...);
    progress.step();
  }
}

}  // namespace berth::lab
