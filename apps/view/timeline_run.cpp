#include "apps/view/timeline_run.hpp"

#include <chrono>
#include <exception>

#include "apps/view/curves.hpp"
#include "berth/scene/plausibility.hpp"
#include "berth/scene/scene_run.hpp"

namespace berth::app {
namespace {

using TimelineClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenMessages{250};

/// Thrown where the run is to end.
struct RunStopped {};

}  // namespace

TimelineRun::TimelineRun(Publish publish) : publish_(std::move(publish)) {
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

void TimelineRun::start(std::shared_ptr<const OpenScene> scene) {
  {
    const std::scoped_lock lock(mutex_);
    next_ = std::move(scene);
  }
  wake_.notify_one();
}

void TimelineRun::work() {
  while (true) {
    std::shared_ptr<const OpenScene> scene;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return is_ending_ || next_; });
      if (is_ending_) return;
      scene = std::move(next_);
    }
    run(*scene);
  }
}

bool TimelineRun::has_news() {
  const std::scoped_lock lock(mutex_);
  return is_ending_ || next_;
}

void TimelineRun::run(const OpenScene& scene) {
  Curves curves(scene.frame_count, scene.frame_count);
  publish_("timeline", curves.message());
  const auto pause = [this] {
    if (has_news()) throw RunStopped{};
  };
  try {
    SceneRun run(scene, {}, pause);
    for (const CameraPlausibility& camera : run.plausibility()) curves.warn(text_of(camera));
    auto told = TimelineClock::now();
    while (run.next()) {
      pause();
      curves.add(run.ask());
      if (TimelineClock::now() - told < kBetweenMessages) continue;
      publish_("timeline", curves.message());
      told = TimelineClock::now();
    }
    publish_("timeline", curves.message());
  } catch (const RunStopped&) {
    return;
  } catch (const std::exception& error) {
    publish_("timeline", curves.message(error.what()));
  }
}

}  // namespace berth::app
