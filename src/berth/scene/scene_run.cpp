#include "berth/scene/scene_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "berth/record/recorder.hpp"
#include "berth/scene/repeated_request.hpp"

namespace berth {

std::vector<ImageStep> scene_steps(const OpenScene& scene) {
  std::vector<ImageStep> steps;
  for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
    const OpenCamera& camera = scene.cameras[c];
    for (std::size_t k = 0; k < camera.source.depth.size(); ++k) {
      steps.push_back({c, k, camera.at_exposure[k].stamp_s, 0, true, 0});
    }
  }
  std::ranges::stable_sort(steps, {}, &ImageStep::stamp_s);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i].begins_result = i == 0 || steps[i - 1].stamp_s != steps[i].stamp_s;
    steps[i].result = i == 0 ? 0 : steps[i - 1].result + (steps[i].begins_result ? 1 : 0);
  }
  for (std::size_t i = steps.size(); i-- > 0;) {
    const bool is_last = i + 1 == steps.size() || steps[i + 1].begins_result;
    steps[i].known = is_last ? i + 1 : steps[i + 1].known;
  }
  return steps;
}

namespace {

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

std::vector<std::string> names_of(const std::vector<OpenCamera>& cameras) {
  std::vector<std::string> names;
  for (const OpenCamera& camera : cameras) names.push_back(camera.source.name);
  return names;
}

MonitorLoop make_loop(const OpenScene& scene, bool is_monitored) {
  try {
    return {scene.robot, names_of(scene.cameras),
            is_monitored ? scene.separation : std::optional<SeparationSettings>()};
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", scene.file.string(), error.what()));
  }
}

}  // namespace

SceneRun::SceneRun(const OpenScene& scene, const std::function<void()>& before_image)
    : SceneRun(scene, require_plausible(scene), true) {
  require_choice(scene);
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!plausibility_[i].is_implausible) cameras_[i].begin_background(before_image);
  }
}

SceneRun::SceneRun(const OpenScene& scene, SingleSteps)
    : SceneRun(scene, std::vector<CameraPlausibility>(scene.cameras.size()), false) {
  for (CameraFrames& camera : cameras_) {
    camera.tell_watch(nullptr);
    camera.begin_given_background();
  }
}

SceneRun::SceneRun(const OpenScene& scene, std::vector<CameraPlausibility> known, bool is_monitored)
    : scene_(scene),
      plausibility_(std::move(known)),
      steps_(scene_steps(scene)),
      kept_(scene.cameras.size()),
      loop_(make_loop(scene, is_monitored)) {
  std::map<std::pair<int, int>, FramePool> pools;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const Camera& size = scene.cameras[i].mounted->camera();
    cameras_.emplace_back(scene.cameras[i], pools[{size.width_px, size.height_px}]);
    if (plausibility_[i].is_implausible) cameras_[i].distrust();
  }
}

SceneRun::~SceneRun() = default;

void SceneRun::observe(std::size_t camera, std::size_t image) {
  cameras_[camera].observe(image);
  if (recorder_) recorder_->put(*cameras_[camera].frame(), cameras_[camera].depth_m());
}

bool SceneRun::next() {
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
  recorder_ = &recorder;
  loop_.record_with(recorder_);
  for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
    const std::optional<DepthImage> background = background_m(i);
    if (background) recorder.put_background(*scene_.cameras[i].mounted, *background);
  }
}

void SceneRun::go_to(std::size_t step, const Result* found) {
  step_ = step + 1;
  observed_ = steps_[step].known;
  std::vector<bool> has_image(scene_.cameras.size());
  for (std::size_t i = observed_; i-- > 0;) {
    const ImageStep& at = steps_[i];
    if (has_image[at.camera]) continue;
    has_image[at.camera] = true;
    if (cameras_[at.camera].number() != at.frame) cameras_[at.camera].observe(at.frame);
  }
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    if (!has_image[c]) cameras_[c].forget();
    cameras_[c].tell_watch(found ? &found->cameras[c].watch : nullptr);
  }
  keep_frames();
}

void SceneRun::keep_frames() {
  std::ranges::transform(cameras_, kept_.begin(), &CameraFrames::frame);
}

Result SceneRun::ask(int repeat) {
  const auto ask = [this](int i) -> const Result& {
    if (i > 0) loop_.forget();
    return loop_.ask({.frames = kept_, .stop = stop_});
  };
  std::optional<RequestTiming> timing;
  const Result& asked = ask_repeatedly(repeat, ask, timing);
  if (loop_.has_monitor()) scene_.joints->velocity(asked.joints_stamp_s, velocity_);
  Result told = loop_.monitor(velocity_, step().stamp_s);
  told.timing = timing;
  tell_scene(told);
  return told;
}

void SceneRun::tell_scene(Result& result) {
  result.frame = static_cast<int>(step().result);
  result.stamp_s = step().stamp_s;
  for (std::size_t i = 0; i < result.cameras.size(); ++i) {
    if (!cameras_[i].number()) continue;
    result.cameras[i].frame = static_cast<int>(*cameras_[i].number());
    result.cameras[i].self_filter = cameras_[i].frame()->obstacles.count;
  }
}

}  // namespace berth
