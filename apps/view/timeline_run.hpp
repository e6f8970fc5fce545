// All frames of a scene in the background, for what is drawn over time.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "apps/view/page_message.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth::app {

/// Runs scenes as `berth run` does, one after another in one thread, and publishes how far it is
/// and what it found, several times a second (kind "timeline").
class TimelineRun {
 public:
  explicit TimelineRun(Publish publish);
  ~TimelineRun();
  TimelineRun(const TimelineRun&) = delete;
  TimelineRun& operator=(const TimelineRun&) = delete;

  /// Begins with this scene as soon as what still runs has ended, after its image. Does not wait.
  void start(std::shared_ptr<const OpenScene> scene);

 private:
  void work();
  bool has_news();
  void run(const OpenScene& scene);

  Publish publish_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::shared_ptr<const OpenScene> next_;
  bool is_ending_ = false;
  std::thread thread_;
};

}  // namespace berth::app
