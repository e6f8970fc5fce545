#include "apps/view/scene_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "berth/scene/answer_result.hpp"

namespace berth::app {
namespace {

std::shared_ptr<const Robot> require_processor(const OpenScene& scene) {
  const Method method = scene.robot->settings().method;
  if (!runs_on_opengl(method)) return scene.robot;
  throw std::runtime_error(
      fmt::format("{}: evaluation.method: {} runs on OpenGL; expected one "
                  "that runs on the processor",
                  scene.file.string(), name_of(method)));
}

}  // namespace

SceneFrames::SceneFrames(std::shared_ptr<const OpenScene> scene)
    : scene_(std::move(scene)),
      steps_(scene_steps(*scene_)),
      cameras_(scene_->cameras.size()),
      frames_(scene_->cameras.size()),
      asker_(require_processor(*scene_)) {
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    const OpenCamera& camera = scene_->cameras[c];
    cameras_[c].observer = std::make_unique<Observer>(camera.view);
    if (camera.background_m) cameras_[c].observer->set_background(*camera.background_m);
  }
}

void SceneFrames::show(std::size_t step) {
  step_ = step;
  const std::size_t known = steps_known_at(*scene_, steps_, step);
  std::fill(frames_.begin(), frames_.end(), nullptr);
  for (std::size_t i = known; i-- > 0;) {
    const ImageStep& at = steps_[i];
    if (frames_[at.camera]) continue;
    if (!has_mesh() && at.camera != steps_[step].camera) break;
    observe(at.camera, at.frame);
    frames_[at.camera] = &cameras_[at.camera].frame;
  }
  if (!has_mesh()) return;
  const std::optional<double> now_s =
      frames_.size() > 1 ? std::optional(steps_[step].stamp_s) : std::nullopt;
  frame_set_.assign(frames_, scene_->robot->settings().time, now_s);
}

void SceneFrames::observe(std::size_t c, std::size_t number) {
  CameraFrames& camera = cameras_[c];
  if (camera.number == number) return;
  const OpenCamera& source = scene_->cameras[c];
  // Means are taken over the images before.
  const auto memory =
      static_cast<std::size_t>(std::max(1, source.view->settings().sensor.average_frames));
  const bool goes_on = camera.number && *camera.number + 1 == number;
  const std::size_t first = goes_on ? number : number + 1 - std::min(memory, number + 1);
  for (std::size_t k = first; k <= number; ++k) {
    camera.depth_m = source.read_depth(k);
    camera.observer->observe(camera.depth_m, source.at_exposure[k], camera.frame,
                             source.exposure_time[k]);
  }
  camera.frame.watch.has_moved = false;
  camera.frame.watch.is_implausible = false;
  camera.number = number;
}

FrameResult SceneFrames::ask() {
  const Answer& answer =
      has_mesh() ? asker_.ask(frame_set_) : asker_.ask(*frames_[steps_[step_].camera]);
  FrameResult result = result_of(*scene_->robot, answer);
  result.frame = static_cast<int>(has_mesh() ? step_ : steps_[step_].frame);
  result.stamp_s = steps_[step_].stamp_s;
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    if (has_mesh() || frames_[c]) result.cameras.push_back(camera_result(c, answer));
  }
  return result;
}

CameraResult SceneFrames::camera_result(std::size_t c, const Answer& answer) const {
  CameraResult camera;
  camera.name = scene_->cameras[c].source.name;
  if (!frames_[c]) return camera;
  const Frame& frame = *frames_[c];
  camera.frame = static_cast<int>(frame_number(c));
  camera.X_BC = frame.X_BC;
  camera.self_filter = frame.obstacles.count;
  camera.state = has_mesh() ? answer.cameras[c]
                            : camera_state(frame, frame.stamp_s, scene_->robot->settings().time);
  return camera;
}

}  // namespace berth::app
