#include "apps/view/timeline_run.hpp"

#include <malloc.h>

#include <chrono>
#include <exception>

#include "apps/view/curves.hpp"
#include "berth/scene/plausibility.hpp"
#include "berth/scene/scene_run.hpp"

namespace berth::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenMessages{250};

/// Thrown where the run is to end.
struct RunStopped {};

/// Null where no background was learned.
std::shared_ptr<const OpenScene> with_backgrounds(const OpenScene& scene, const SceneRun& run) {
  std::shared_ptr<OpenScene> learned;
  for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
    if (scene.cameras[c].background_m) continue;
    std::optional<DepthImage> background_m = run.background_m(c);
    if (!background_m) continue;
    if (!learned) learned = std::make_shared<OpenScene>(scene);
    learned->cameras[c].background_m = std::move(background_m);
  }
  return learned;
}

}  // namespace

TimelineRun::TimelineRun(Publish publish, std::function<void()> has_news)
    : publish_(std::move(publish)), has_news_(std::move(has_news)) {
  thread_ = std::thread([this] { work(); });
}

TimelineRun::~TimelineRun() {
  {
    const std::scoped_lock lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void TimelineRun::stop() {
  const std::scoped_lock lock(mutex_);
  is_stopped_ = true;
  next_.reset();
  results_.clear();
  learned_.reset();
  has_failed_ = false;
}

void TimelineRun::start(std::shared_ptr<const OpenScene> scene) {
  stop();
  {
    const std::scoped_lock lock(mutex_);
    next_ = std::move(scene);
  }
  wake_.notify_one();
}

StepFinding TimelineRun::find(std::size_t step) {
  const std::scoped_lock lock(mutex_);
  missed_.reset();
  if (step < results_.size()) return {results_[step]};
  if (!has_failed_) missed_ = step;
  return {nullptr, has_failed_};
}

std::shared_ptr<const OpenScene> TimelineRun::learned() {
  const std::scoped_lock lock(mutex_);
  return learned_;
}

void TimelineRun::work() {
  while (true) {
    std::shared_ptr<const OpenScene> scene;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return is_ending_ || next_; });
      if (is_ending_) return;
      scene = std::move(next_);
      is_stopped_ = false;
    }
    try {
      run(*scene);
      // Its frames were large: what they took goes back to the system, which it does not by itself.
      malloc_trim(0);
    } catch (const RunStopped&) {
    }
  }
}

void TimelineRun::pause() {
  const std::scoped_lock lock(mutex_);
  if (is_ending_ || is_stopped_) throw RunStopped{};
}

void TimelineRun::note(const std::function<void()>& change) {
  {
    const std::scoped_lock lock(mutex_);
    if (is_ending_ || is_stopped_) throw RunStopped{};
    change();
    if (!missed_ || (*missed_ >= results_.size() && !has_failed_)) return;
    missed_.reset();
  }
  has_news_();
}

void TimelineRun::run(const OpenScene& scene) {
  Curves curves(scene.frame_count, scene.frame_count);
  publish_("timeline", curves.message());
  try {
    SceneRun run(scene, [this] { pause(); });
    note([&, learned = with_backgrounds(scene, run)] { learned_ = learned; });
    for (const CameraPlausibility& camera : run.plausibility()) curves.warn(text_of(camera));
    auto told = Clock::now();
    while (run.next()) {
      pause();
      auto result = std::make_shared<const Result>(run.ask());
      curves.add(*result);
      note([&] { results_.push_back(std::move(result)); });
      if (Clock::now() - told < kBetweenMessages) continue;
      publish_("timeline", curves.message());
      told = Clock::now();
    }
    publish_("timeline", curves.message());
  } catch (const std::exception& error) {
    publish_("timeline", curves.message(error.what()));
    note([&] { has_failed_ = true; });
  }
}

}  // namespace berth::app
