#include "lab/bench/stages.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "apps/support/interrupt.hpp"
#include "apps/support/progress_bar.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "lab/bench/coarse_robot.hpp"
#include "lab/bench/embree_rays.hpp"
#include "lab/bench/stage.hpp"
#include "thesis/image_method.hpp"
#include "thesis/image_query.hpp"
#include "thesis/image_result.hpp"
#include "thesis/mean_direction/mean_direction.hpp"

namespace berth::lab {
namespace {

/// Requests between two images: a controller asks more often than a camera sees.
constexpr std::size_t kRequests = 5;

/// The pipeline taken apart. Each run fills the frame as Observer and ImageQuery do.
class Stages {
 public:
  explicit Stages(const Recording& recording)
      : camera_(recording.camera()),
        mounted_(camera_.mounted),
        renderer_(mounted_->robot()->meshes(), mounted_->camera()),
        rays_(mounted_->robot()->model(), mounted_->camera()),
        observer_(mounted_),
        query_(mounted_->robot(), Method::exact),
        settings_(settings_of(*mounted_->robot(), {})) {
    settings_.mean_direction = false;
  }

  void run(DepthView depth_m, std::size_t frame_number) {
    const JointState& joints = camera_.at_exposure[frame_number];
    run_apart(depth_m, joints);
    whole_.take([&] {
      observer_.observe(depth_m, joints, frame_);
      query_.ask(frame_);
    });
    const std::vector<JointState>& joints_of = camera_.at_exposure;
    for (std::size_t k = 1; k <= kRequests; ++k) {
      const JointState& next = joints_of[(frame_number + k) % joints_of.size()];
      request_.take([&] { query_.ask(frame_, next); });
    }
  }

  void run_embree(std::size_t frame_number) {
    forward_kinematics(mounted_->robot()->model(), camera_.at_exposure[frame_number].position,
                       pose_);
    embree_.take([&] { rays_.render(pose_, mounted_->camera_pose(pose_), traced_); });
  }

  void forget_times() {
    for (Stage* stage : all()) stage->times_ms.clear();
  }

  std::vector<Stage*> all() {
    return {&render_, &self_filter_, &both_, &tree_, &exact_, &mean_, &whole_, &request_, &embree_};
  }

 private:
  void run_apart(DepthView depth_m, const JointState& joints) {
    render_.take([&] {
      forward_kinematics(mounted_->robot()->model(), joints.position, pose_);
      renderer_.render(pose_, mounted_->camera_pose(pose_), frame_.robot);
    });
    self_filter_.take([&] {
      self_filter(mounted_->camera(), depth_m, frame_.robot, mounted_->settings().self_filter,
                  filter_, frame_.obstacles);
    });
    both_.times_ms.push_back(render_.times_ms.back() + self_filter_.times_ms.back());
    tree_.take([&] { searchable_.build(frame_.obstacles.depth_m); });
    distances_.links.clear();
    const ImageRequest request{mounted_->camera(), frame_.robot,
                               mounted_->robot()->model().link_count(), searchable_, settings_};
    exact_.take([&] { evaluate(Method::exact, request, workspace_, distances_); });
    mean_.take([&] { fill_mean_directions(request, workspace_.directions, distances_); });
  }

  const OpenCamera& camera_;
  std::shared_ptr<const MountedCamera> mounted_;
  RobotRenderer renderer_;
  EmbreeRays rays_;
  RobotImage traced_;
  RobotPose pose_;
  SelfFilterWorkspace filter_;
  EvaluateWorkspace workspace_;
  LinkDistances distances_;
  Observer observer_;
  ImageQuery query_;
  Frame frame_;
  SearchableDepth searchable_;
  ImageDistanceSettings settings_;
  Stage render_{"render"};
  Stage self_filter_{"self filter"};
  Stage both_{"render and self filter"};
  Stage tree_{"obstacle tree"};
  Stage exact_{"exact, cold"};
  Stage mean_{"mean direction, on top"};
  Stage whole_{"depth image to result"};
  Stage request_{"request at new joint angles"};
  Stage embree_{"Embree rays, same pixels"};
};

}  // namespace

Table measure_stages(const Recording& recording, int threads, int rounds) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const OpenCamera& camera = recording.camera();
  const std::size_t frames = camera.source.depth.size();
  const std::string title =
      fmt::format("Stages, {}, {} thread{}", recording.title, threads, threads == 1 ? "" : "s");
  Stages stages(recording);
  app::ProgressBar progress(title, frames);
  // Frame by frame, since the images of all of them together are large.
  for (std::size_t i = 0; i < frames; ++i) {
    const DepthImage depth_m = camera.read_depth(i);
    for (int round = 0; round <= rounds; ++round) {
      app::stop_if_interrupted();
      stages.run(depth_m, i);
      if (i == 0 && round == 0) stages.forget_times();
    }
    progress.step();
  }
  // Apart, since its meshes would drive berth's out of the caches.
  for (std::size_t i = 0; i < frames; ++i) {
    for (int round = 0; round <= rounds; ++round) stages.run_embree(i);
  }

  return table_of(
      title,
      fmt::format("{} x {}, {} triangles, {} links, {} frames, each {} times. The image to "
                  "result and the request are the whole pipeline, with mean directions; "
                  "Embree is beside it.",
                  camera.mounted->camera().width_px, camera.mounted->camera().height_px,
                  triangle_count(camera.mounted->robot()->model()),
                  camera.mounted->robot()->model().link_count(), frames, rounds + 1),
      stages.all());
}

}  // namespace berth::lab
