// All frames of a scene in the background.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "apps/view/page_message.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth::app {

/// What a run says of one step of its scene.
struct StepFinding {
  /// Null where it has not come there.
  std::shared_ptr<const Result> result;
  /// The run has ended with an error before: it will never come there.
  bool has_failed = false;
};

/// Runs scenes as `berth run` does, one after another in one thread, and publishes how far it is
/// and what it found, several times a second (kind "timeline"). It keeps the result of each step,
/// so that the frame on show and the curves say the same.
class TimelineRun {
 public:
  /// `has_news` is called in the run's thread once there is more to find() of the step that was
  /// asked for last.
  TimelineRun(Publish publish, std::function<void()> has_news);
  ~TimelineRun();
  TimelineRun(const TimelineRun&) = delete;
  TimelineRun& operator=(const TimelineRun&) = delete;

  /// Ends what runs, after its image, and drops what was found. Does not wait.
  void stop();
  /// Stops, and begins with this scene. Does not wait.
  void start(std::shared_ptr<const OpenScene> scene);

  /// The finding at a step of the scene that was started last.
  StepFinding find(std::size_t step);
  /// The scene with the backgrounds that the run has learned of it; null where it has learned none,
  /// or has not yet.
  std::shared_ptr<const OpenScene> learned();

 private:
  void work();
  void run(const OpenScene& scene);
  /// Throws where the run is to end.
  void pause();
  /// Changes what was found, unless that was dropped meanwhile, and reports it where somebody waits
  /// for it. Throws as pause() does.
  void note(const std::function<void()>& change);

  Publish publish_;
  std::function<void()> has_news_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::shared_ptr<const OpenScene> next_;
  bool is_stopped_ = false;
  bool is_ending_ = false;
  std::vector<std::shared_ptr<const Result>> results_;
  std::shared_ptr<const OpenScene> learned_;
  bool has_failed_ = false;
  /// The step that find() did not know.
  std::optional<std::size_t> missed_;
  /// The last member: the thread uses all the others.
  std::thread thread_;
};

}  // namespace berth::app
