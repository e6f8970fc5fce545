#include "berth/scene/scene_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <stdexcept>
#include <utility>

#include "berth/record/recorder.hpp"
#include "berth/scene/frame_pipeline.hpp"
#include "berth/scene/gl_backend.hpp"
#include "berth/scene/learn_background.hpp"

namespace berth {
namespace {

/// Throws where no camera is left, and where the joints are wrong: then the other cameras look for
/// the robot in the wrong place, too, even if they do not see enough of it to tell.
std::vector<CameraPlausibility> plausible_cameras(const OpenScene& scene) {
  std::vector<CameraPlausibility> cameras = find_implausible(scene);
  if (!std::ranges::all_of(cameras, &CameraPlausibility::is_implausible) &&
      std::ranges::all_of(cameras, [](const auto& one) { return one.in_joints.empty(); })) {
    return cameras;
  }
  std::string text;
  for (const CameraPlausibility& camera : cameras) {
    if (!camera.is_implausible) continue;
    text += fmt::format("{}{}: {}", text.empty() ? "" : "\n", scene.file.string(), text_of(camera));
  }
  throw std::runtime_error(text);
}

/// A monitor must not take black clothes for nothing because nobody thought of them. Who calibrates
/// the scene, or asks the doctor, need not have chosen yet.
void require_choice(const OpenScene& scene) {
  if (!scene.separation || scene.separation->no_reading) return;
  const auto untold = std::ranges::find_if_not(scene.cameras, tells_unread);
  if (untold == scene.cameras.end()) return;
  throw std::runtime_error(fmt::format(
      "{}: separation.no_reading: missing, and camera {} does not tell what gives no reading, such "
      "as black clothes; expected a background of that camera (berth calibrate writes it), or "
      "space.no_reading: hides, or separation.no_reading: ignore, assume_range or stop",
      scene.file.string(), untold->source.name));
}

}  // namespace

SceneRun::SceneRun(const OpenScene& scene, const BackendChoice& where,
                   const std::function<void()>& before_image)
    : SceneRun(scene, where, plausible_cameras(scene)) {
  require_choice(scene);
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    if (!plausibility_[i].is_implausible) begin_background(i, before_image);
  }
  make_monitors();
}

SceneRun::SceneRun(const OpenScene& scene, SingleSteps)
    : SceneRun(scene, BackendChoice{}, std::vector<CameraPlausibility>(scene.cameras.size())) {
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    pipelines_[i]->tell_watch(nullptr);
    if (!scene.cameras[i].view->settings().sensor.has_background()) continue;
    if (scene.cameras[i].background_m)
      pipelines_[i]->set_background(*scene.cameras[i].background_m);
  }
}

SceneRun::SceneRun(const OpenScene& scene, const BackendChoice& where,
                   std::vector<CameraPlausibility> known)
    : scene_(scene),
      plausibility_(std::move(known)),
      newest_(scene.cameras.size()),
      steps_(scene_steps(scene)),
      kept_(scene.cameras.size()) {
  make_pipelines(where);
  if (!scene.joins_cameras()) {
    ask_ = [this](bool) -> const Result& { return pipelines_[step().camera]->ask(); };
    return;
  }
  std::vector<std::string> names;
  for (const OpenCamera& camera : scene.cameras) names.push_back(camera.source.name);
  query_.emplace(scene.robot, std::move(names));
  ask_ = [this](bool anew) -> const Result& {
    if (anew) query_->forget();
    const Request request{.frames = kept_, .stop = stop_};
    return recorder_ ? recorder_->ask(*query_, request) : query_->ask(request);
  };
}

SceneRun::~SceneRun() = default;

void SceneRun::make_pipelines(const BackendChoice& where) {
  gl_ = needed_gl_backend(scene_.method, where);
  std::map<std::pair<int, int>, FramePool> pools;
  for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
    const OpenCamera& camera = scene_.cameras[i];
    const int width_px = camera.view->camera().width_px,
              height_px = camera.view->camera().height_px;
    try {
      pipelines_.push_back(
          where.backend == Backend::opengl
              ? gl_->make_pipeline(scene_, camera)
              : make_cpu_pipeline(scene_, camera, pools[{width_px, height_px}], gl_.get()));
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(fmt::format("{}: {}", scene_.file.string(), error.what()));
    }
    if (plausibility_[i].is_implausible) pipelines_[i]->distrust();
  }
}

void SceneRun::make_monitors() {
  if (!scene_.separation) return;
  try {
    for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
      monitors_.emplace_back(scene_.robot, *scene_.separation);
    }
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", scene_.file.string(), error.what()));
  }
}

void SceneRun::begin_background(std::size_t i, const std::function<void()>& before_image) {
  const OpenCamera& camera = scene_.cameras[i];
  if (!camera.view->settings().sensor.has_background()) return;
  if (camera.background_m) return pipelines_[i]->set_background(*camera.background_m);
  learn_background(camera, images_to_learn_from(camera), before_image,
                   [&](DepthView depth_m, const Frame& frame) {
                     pipelines_[i]->learn_background(depth_m, frame);
                   });
}

void SceneRun::observe(std::size_t of, std::size_t frame) {
  const OpenCamera& camera = scene_.cameras[of];
  Newest& newest = newest_[of];
  newest.number = frame;
  newest.depth_m = camera.read_depth(frame);
  pipelines_[of]->observe(newest.depth_m, camera.at_exposure[frame], camera.exposure_time[frame]);
  if (recorder_) recorder_->put(*pipelines_[of]->frame(), newest.depth_m);
}

void SceneRun::observe_alone(const ImageStep& step) {
  const std::optional<std::size_t> before = newest_[step.camera].number;
  if (before == step.frame) return;
  const SensorSettings& sensor = scene_.cameras[step.camera].view->settings().sensor;
  const auto memory = static_cast<std::size_t>(std::max(1, sensor.average_frames));
  const bool goes_on = before && *before + 1 == step.frame;
  std::size_t first = goes_on ? step.frame : step.frame + 1 - std::min(memory, step.frame + 1);
  for (; first <= step.frame; ++first) observe(step.camera, first);
}

bool SceneRun::next() {
  if (step_ > 0 && gl_) gl_->check(camera().source.name);
  if (step_ == steps_.size()) return false;
  ++step_;
  if (observed_ >= step_) return true;
  for (; observed_ < step().known; ++observed_) {
    observe(steps_[observed_].camera, steps_[observed_].frame);
  }
  keep_frames();
  return true;
}

void SceneRun::record_with(Recorder& recorder) {
  if (!query_) {
    throw std::invalid_argument(fmt::format("{}: method {}: expected mesh, to be recorded",
                                            scene_.file.string(), name_of(scene_.method)));
  }
  recorder_ = &recorder;
  for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
    const std::optional<DepthImage> background = background_m(i);
    if (background) recorder.put_background(*scene_.cameras[i].view, *background);
  }
}

std::optional<DepthImage> SceneRun::background_m(std::size_t camera) const {
  return pipelines_[camera]->background_m();
}

void SceneRun::go_to(std::size_t step, const Result* found) {
  step_ = step + 1;
  observed_ = steps_[step].known;
  const std::size_t first = steps_[step].first_camera, count = steps_[step].camera_count;
  std::vector<bool> has_image(scene_.cameras.size());
  for (std::size_t i = observed_; i-- > 0;) {
    const ImageStep& at = steps_[i];
    if (has_image[at.camera] || at.camera < first || at.camera >= first + count) continue;
    has_image[at.camera] = true;
    observe_alone(at);
  }
  for (std::size_t c = 0; c < has_image.size(); ++c) {
    if (!has_image[c]) newest_[c].number.reset();
  }
  for (std::size_t i = 0; i < count; ++i) {
    pipelines_[first + i]->tell_watch(found ? &found->cameras[i].watch : nullptr);
  }
  keep_frames();
}

void SceneRun::keep_frames() {
  for (std::size_t c = 0; c < kept_.size(); ++c) {
    kept_[c] = newest_[c].number ? pipelines_[c]->kept() : nullptr;
  }
}

std::shared_ptr<const Frame> SceneRun::frame() { return pipelines_[step().camera]->frame(); }

Result SceneRun::ask(int repeat) {
  std::vector<double> times_us;
  const Result* result = nullptr;
  for (int i = 0; i < std::max(1, repeat); ++i) {
    const auto start = std::chrono::steady_clock::now();
    result = &ask_(i > 0);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    times_us.push_back(took.count());
  }
  Result told = *result;
  if (repeat > 0) told.timing = timing_of(std::move(times_us));
  tell_scene(told);
  monitor(told);
  return told;
}

void SceneRun::tell_scene(Result& result) {
  result.frame = static_cast<int>(step().result);
  result.stamp_s = step().stamp_s;
  if (gl_) result.gl_renderer = gl_->renderer();
  for (std::size_t i = 0; i < result.cameras.size(); ++i) {
    const std::size_t c = step().first_camera + i;
    if (!newest_[c].number) continue;
    result.cameras[i].frame = static_cast<int>(*newest_[c].number);
    result.cameras[i].self_filter = pipelines_[c]->fate_counts();
  }
}

void SceneRun::monitor(Result& result) {
  if (monitors_.empty()) return;
  scene_.joints->velocity(result.joints_stamp_s, velocity_);
  SeparationMonitor& own = monitors_[step().first_camera];
  const FrameSet* const frames = query_ ? &query_->frames() : nullptr;
  result.separation = recorder_ ? recorder_->update(own, result, velocity_, result.stamp_s, frames)
                                : own.update(result, velocity_, result.stamp_s, frames);
}

}  // namespace berth
