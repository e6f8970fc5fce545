#include "berth/scene/scene_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "berth/scene/answer_result.hpp"
#include "berth/scene/frame_pipeline.hpp"
#include "berth/scene/learn_background.hpp"

namespace berth {
namespace {

/// Throws where no camera is left.
std::vector<CameraPlausibility> plausible_cameras(const OpenScene& scene) {
  std::vector<CameraPlausibility> cameras = find_implausible(scene);
  if (!std::ranges::all_of(cameras, &CameraPlausibility::is_implausible)) return cameras;
  std::string text;
  for (const CameraPlausibility& camera : cameras) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : "\n", scene.file.string(), text_of(camera));
  }
  throw std::runtime_error(text);
}

}  // namespace

SceneRun::SceneRun(const OpenScene& scene, const BackendChoice& where,
                   const std::function<void()>& before_image)
    : scene_(scene),
      plausibility_(plausible_cameras(scene)),
      newest_(scene.cameras.size()),
      kept_(scene.cameras.size()),
      frames_(scene.cameras.size()) {
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
    if (plausibility_[i].is_implausible) {
      pipelines_[i]->distrust();
    } else {
      begin_background(i, before_image);
    }
  }
  if (has_mesh()) asker_.emplace(scene.robot);
  make_monitors();
  steps_ = scene_steps(scene);
}

SceneRun::~SceneRun() = default;

bool SceneRun::has_mesh() const { return scene_.robot->settings().method == Method::mesh; }

void SceneRun::make_monitors() {
  if (!scene_.separation) return;
  try {
    const SeparationMonitor monitor(scene_.robot, *scene_.separation);
    monitors_.assign(has_mesh() ? 1 : scene_.cameras.size(), monitor);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", scene_.file.string(), error.what()));
  }
}

void SceneRun::begin_background(std::size_t i, const std::function<void()>& before_image) {
  const OpenCamera& camera = scene_.cameras[i];
  if (!camera.view->settings().sensor.has_background()) return;
  if (camera.background_m) return pipelines_[i]->set_background(*camera.background_m);
  learn_background(camera, before_image, [&](DepthView depth_m, const Frame& frame) {
    pipelines_[i]->learn_background(depth_m, frame);
  });
}

void SceneRun::observe(const ImageStep& step) {
  const OpenCamera& camera = scene_.cameras[step.camera];
  Newest& newest = newest_[step.camera];
  newest.number = step.frame;
  newest.depth_m = camera.read_depth(step.frame);
  pipelines_[step.camera]->observe(newest.depth_m, camera.at_exposure[step.frame],
                                   camera.exposure_time[step.frame]);
}

bool SceneRun::next() {
  if (step_ > 0 && gl_) gl_->check(camera().source.name);
  if (step_ == steps_.size()) return false;
  ++step_;
  if (observed_ >= step_) return true;
  const std::size_t known = steps_known_at(scene_, steps_, step_ - 1);
  while (observed_ < known) observe(steps_[observed_++]);
  if (has_mesh()) assign_frames();
  return true;
}

void SceneRun::assign_frames() {
  for (std::size_t c = 0; c < frames_.size(); ++c) {
    if (newest_[c].number) kept_[c] = pipelines_[c]->frame();
    frames_[c] = kept_[c].get();
  }
  // One camera's frame is new whenever it is asked.
  const std::optional<double> now_s =
      frames_.size() > 1 ? std::optional(step().stamp_s) : std::nullopt;
  frame_set_.assign(frames_, scene_.robot->settings().time, now_s);
}

std::shared_ptr<const Frame> SceneRun::frame() { return pipelines_[step().camera]->frame(); }

FrameResult SceneRun::ask(int repeat) {
  std::vector<double> times_us;
  const Answer* answer = nullptr;
  for (int i = 0; i < std::max(1, repeat); ++i) {
    if (i > 0 && asker_) asker_->forget();
    const auto start = std::chrono::steady_clock::now();
    answer = asker_ ? &asker_->ask(frame_set_) : &pipelines_[step().camera]->ask();
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    times_us.push_back(took.count());
  }
  FrameResult result = result_of(*answer);
  if (repeat > 0) result.timing = timing_of(std::move(times_us));
  result.timing_name = "ask_us";
  if (!monitors_.empty()) result.separation = &look(*answer, result);
  return result;
}

const Separation& SceneRun::look(const Answer& answer, const FrameResult& result) {
  scene_.joints->at(answer.joints_stamp_s, scene_.robot->settings().time.joints, joints_);
  scene_.joints->velocity(answer.joints_stamp_s, velocity_);
  std::vector<CameraState> states;
  for (const CameraResult& camera : result.cameras) states.push_back(camera.state);
  if (has_mesh()) {
    return monitors_.front().look(
        {answer, states, kept_, joints_.position, velocity_, result.stamp_s});
  }
  const std::shared_ptr<const Frame> shown = frame();
  return monitors_[step().camera].look(
      {answer, states, {&shown, 1}, joints_.position, velocity_, result.stamp_s});
}

FrameResult SceneRun::result_of(const Answer& answer) {
  FrameResult result = berth::result_of(*scene_.robot, answer);
  // Lines are counted where all cameras answer together.
  result.frame = static_cast<int>(has_mesh() ? step_ - 1 : step().frame);
  result.stamp_s = step().stamp_s;
  if (gl_) result.gl_renderer = gl_->renderer();
  for (std::size_t c = 0; c < scene_.cameras.size(); ++c) {
    if (has_mesh() || c == step().camera) result.cameras.push_back(camera_result(c, answer));
  }
  return result;
}

CameraResult SceneRun::camera_result(std::size_t c, const Answer& answer) {
  CameraResult camera;
  camera.name = scene_.cameras[c].source.name;
  if (!newest_[c].number) return camera;
  camera.frame = static_cast<int>(*newest_[c].number);
  const Exposure& exposure = pipelines_[c]->exposure();
  camera.X_BC = exposure.X_BC;
  camera.self_filter = pipelines_[c]->fate_counts();
  if (has_mesh()) {
    camera.state = answer.cameras[c];
  } else {
    camera.state = camera_state(exposure, exposure.stamp_s, scene_.robot->settings().time);
  }
  return camera;
}

}  // namespace berth
