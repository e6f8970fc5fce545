#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "apps/support/interrupt.hpp"
#include "apps/support/progress_bar.hpp"
#include "berth/robot/surface.hpp"
#include "lab/bench/coarse_robot.hpp"
#include "lab/bench/stage.hpp"
#include "lab/bench/stages.hpp"
#include "thesis/image_result.hpp"
#include "thesis/opengl/gl_evaluate.hpp"
#include "thesis/opengl/gl_frame_images.hpp"
#include "thesis/opengl/gl_observer.hpp"
#include "thesis/opengl/gl_robot_renderer.hpp"
#include "thesis/opengl/gl_self_filter.hpp"

namespace berth::lab {
namespace {

/// Of the lattices' obstacle pixels, in x and y.
constexpr int kLatticeStep = 8;

constexpr Method kGlMethods[] = {Method::gl_exact, Method::gl_lattice, Method::gl_hybrid};

/// A camera's pipeline on the GPU, taken apart, and the whole of it.
class GlStages {
 public:
  GlStages(const std::shared_ptr<const MountedCamera>& mounted, const ImageSettings& images)
      : mounted_(mounted),
        camera_(mounted->camera()),
        upload_(camera_.width_px, camera_.height_px),
        sensor_depth_m_(GlPixel::depth_m, camera_.width_px, camera_.height_px),
        region_(camera_.width_px, camera_.height_px),
        frame_(camera_),
        renderer_(mounted->robot()->model(), camera_),
        observer_(mounted),
        settings_(settings_of(*mounted->robot(), images)) {
    settings_.mean_direction = false;
    settings_.lattice.step_x = settings_.lattice.step_y = kLatticeStep;
    const double scale = mounted->settings().self_filter.robot_region_scale;
    if (scale > 0)
      region_renderer_.emplace(robot_region(mounted->robot()->model(), scale), camera_);
    for (const Method method : kGlMethods) {
      const std::string_view name = name_of(method);
      evaluate_.push_back({fmt::format("{}, read-back included", name)});
      whole_.push_back({fmt::format("depth image to result, {}", name)});
    }
  }

  void run(DepthView depth_m, const JointState& joints) {
    upload_stage_.take([&] {
      upload_.send(depth_m, sensor_depth_m_);
      wait();
    });
    render_stage_.take([&] {
      render(joints);
      wait();
    });
    filter_stage_.take([&] {
      filter();
      wait();
    });
    for (std::size_t i = 0; i < std::size(kGlMethods); ++i) {
      const auto evaluate = [&] { this->evaluate(kGlMethods[i]); };
      evaluate_[i].take(evaluate);
      whole_[i].take([&] {
        observer_.observe(depth_m, joints, frame_);
        evaluate();
      });
    }
  }

  void forget_times() {
    for (Stage* stage : all()) stage->times_ms.clear();
  }

  std::vector<Stage*> all() {
    std::vector<Stage*> stages = {&upload_stage_, &render_stage_, &filter_stage_};
    for (auto* several : {&evaluate_, &whole_}) {
      for (Stage& stage : *several) stages.push_back(&stage);
    }
    return stages;
  }

 private:
  void wait() {
    done_.set();
    done_.wait();
  }

  void render(const JointState& joints) {
    forward_kinematics(mounted_->robot()->model(), joints.position, frame_.pose);
    frame_.X_BC = mounted_->camera_pose(frame_.pose);
    renderer_.render(frame_.pose, frame_.X_BC, frame_.images->robot);
    if (region_renderer_) region_renderer_->render(frame_.pose, frame_.X_BC, region_);
  }

  void filter() {
    const SelfFilterSettings& settings = mounted_->settings().self_filter;
    if (region_renderer_) {
      filter_.filter(camera_, sensor_depth_m_, frame_.images->robot, region_.link_id, settings,
                     frame_.images->obstacles);
    } else {
      filter_.filter(camera_, sensor_depth_m_, frame_.images->robot, settings,
                     frame_.images->obstacles);
    }
  }

  void evaluate(Method method) {
    answer_.links.clear();
    evaluator_.evaluate(method, camera_, frame_.images->robot, frame_.images->obstacles.depth_m,
                        mounted_->robot()->model().link_count(), settings_, answer_);
  }

  std::shared_ptr<const MountedCamera> mounted_;
  Camera camera_;
  GlUpload upload_;
  GlTexture sensor_depth_m_;
  GlRobotImage region_;
  GlFrame frame_;
  GlRobotRenderer renderer_;
  std::optional<GlRobotRenderer> region_renderer_;
  GlSelfFilter filter_;
  GlObserver observer_;
  GlEvaluator evaluator_;
  GlFence done_;
  ImageDistanceSettings settings_;
  LinkDistances answer_;
  Stage upload_stage_{"upload of the depth image"};
  Stage render_stage_{"render"};
  Stage filter_stage_{"self filter"};
  std::vector<Stage> evaluate_;
  std::vector<Stage> whole_;
};

}  // namespace

Table measure_gl_stages(const Recording& recording, int max_frames, int rounds) {
  const std::string title = fmt::format("Stages on OpenGL, {}", recording.title);
  const std::shared_ptr<const MountedCamera>& mounted = recording.camera().mounted;
  const int frames = std::min(max_frames, recording.frame_count());
  GlStages stages(mounted, {});
  app::ProgressBar progress(title, frames);
  for (int i = 0; i < frames; ++i) {
    const std::size_t frame = recording.sampled_frame(i, frames);
    const DepthImage depth_m = recording.camera().read_depth(frame);
    for (int round = 0; round <= rounds; ++round) {
      app::stop_if_interrupted();
      stages.run(depth_m, recording.camera().at_exposure[frame]);
      if (i == 0 && round == 0) stages.forget_times();
    }
    progress.step();
  }
  return table_of(
      title,
      fmt::format("{} x {}, {} triangles, {} links, {} frames, each {} times; without mean "
                  "directions, lattices with steps of {} px, by the clock on the wall. "
                  "Upload, render and self filter each until the GPU has done them; the "
                  "rows below those begin with images on the GPU, but for the last three.",
                  mounted->camera().width_px, mounted->camera().height_px,
                  triangle_count(mounted->robot()->model()), mounted->robot()->model().link_count(),
                  frames, rounds + 1, kLatticeStep),
      stages.all());
}

}  // namespace berth::lab
