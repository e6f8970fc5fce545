#include "berth/scene/scene_run.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "berth/scene/frame_pipeline.hpp"

namespace berth {

SceneRun::SceneRun(const OpenScene& scene, const BackendChoice& where,
                   const std::function<void()>& before_image)
    : scene_(scene) {
  const bool on_gl = where.backend == Backend::opengl;
  if (on_gl || runs_on_opengl(scene.robot->settings().method)) {
    gl_ = open_gl_backend(where.gl_device);
  }
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const auto& view = scene.cameras[i].view;
    try {
      pipelines_.push_back(on_gl ? gl_->make_pipeline(view) : make_cpu_pipeline(view, gl_.get()));
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(fmt::format("{}: {}", scene.file.string(), error.what()));
    }
    learn_background(i, before_image);
  }
}

SceneRun::~SceneRun() = default;

void SceneRun::learn_background(std::size_t i, const std::function<void()>& before_image) {
  const OpenCamera& camera = scene_.cameras[i];
  if (!camera.view->settings().sensor.has_background()) return;
  Observer learner(camera.view);
  Frame frame;
  for (std::size_t k = 0; k < camera.source.depth.size(); ++k) {
    before_image();
    const DepthImage depth_m = camera.read_depth(k);
    learner.observe(depth_m, camera.at_exposure[k], frame, camera.exposure_time[k]);
    pipelines_[i]->learn_background(depth_m, frame);
  }
}

bool SceneRun::next() {
  if (has_begun_ && gl_) gl_->check(camera().source.name);
  frame_ = has_begun_ ? frame_ + 1 : 0;
  has_begun_ = true;
  while (camera_ < scene_.cameras.size() && frame_ >= camera().source.depth.size()) {
    ++camera_;
    frame_ = 0;
  }
  if (camera_ == scene_.cameras.size()) return false;
  depth_m_ = camera().read_depth(frame_);
  pipelines_[camera_]->observe(depth_m_, camera().at_exposure[frame_],
                               camera().exposure_time[frame_]);
  return true;
}

const Frame& SceneRun::frame() { return pipelines_[camera_]->frame(); }

FrameResult SceneRun::ask() {
  FramePipeline& pipeline = *pipelines_[camera_];
  const Answer& answer = pipeline.ask();
  const EvaluationSettings& settings = scene_.robot->settings();
  FrameResult result;
  result.frame = static_cast<int>(frame_);
  result.stamp_s = pipeline.exposure().stamp_s;
  result.camera = camera().source.name;
  result.method = name_of(settings.method);
  result.range_m = settings.distance.range_m;
  result.has_bounds = settings.distance.tolerance_m > 0 || settings.distance.deadline_us;
  result.link_names = scene_.robot->model().evaluated_link_names();
  result.distances = &answer.distances;
  if (settings.visibility) result.visibility = &answer.visibility;
  result.X_BC = pipeline.exposure().X_BC;
  result.time = answer.time;
  result.self_filter = pipeline.fate_counts();
  if (gl_) result.gl_renderer = gl_->renderer();
  return result;
}

}  // namespace berth
