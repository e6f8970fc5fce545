// A calibration of the scene on show, in the background.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "apps/view/page_message.hpp"
#include "berth/scene/open_scene.hpp"
#include "berth/scene/rewrite_scene.hpp"

namespace berth::app {

/// One calibration at a time, in a thread. Publishes what it does and what it found (kind
/// "calibration_data").
class CalibrationRun {
 public:
  explicit CalibrationRun(Publish publish);
  ~CalibrationRun();
  CalibrationRun(const CalibrationRun&) = delete;
  CalibrationRun& operator=(const CalibrationRun&) = delete;

  /// Begins; does nothing while one runs. Waits for one that was dropped, which looks up every few
  /// seconds.
  void start(std::shared_ptr<const OpenScene> scene);
  /// Ends it, as soon as it looks up, and drops what was found. Does not wait.
  void drop();
  /// What was found, once it was; it is dropped then.
  std::optional<SceneChange> take();

 private:
  void run(const OpenScene& scene);

  Publish publish_;
  std::atomic<bool> is_stopped_{false};
  std::atomic<bool> is_running_{false};
  std::mutex mutex_;
  std::optional<SceneChange> found_;
  std::thread thread_;
};

}  // namespace berth::app
