// A calibration of the scene on show, in the background.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "apps/view/page_message.hpp"
#include "berth/scene/calibrate_scene.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth::app {

/// One calibration at a time, in a thread. Publishes what it does, what it asks and what it found
/// (kind "calibration_data").
class CalibrationRun {
 public:
  explicit CalibrationRun(Publish publish);
  ~CalibrationRun();
  CalibrationRun(const CalibrationRun&) = delete;
  CalibrationRun& operator=(const CalibrationRun&) = delete;

  /// Begins; does nothing while one runs. Waits for one that was dropped, which looks up every few
  /// seconds.
  void start(std::shared_ptr<const OpenScene> scene);
  /// Whether the part of this name, which it asks about, is one of the robot. Does nothing where it
  /// does not ask about that one.
  void answer(const std::string& part, bool is_taken);
  /// Ends it, as soon as it looks up, and drops what was found. Does not wait.
  void drop();
  /// What was found, once it was; it is dropped then.
  std::optional<SceneCalibration> take();

 private:
  void run(const OpenScene& scene);
  bool ask(const SceneCalibrationData& material, const AttachedPart& part,
           const CalibrationResult& found);

  Publish publish_;
  std::atomic<bool> is_stopped_{false};
  std::atomic<bool> is_running_{false};
  std::mutex mutex_;
  std::condition_variable answered_;
  /// The part that it asks about; empty: none.
  std::string asked_;
  std::optional<bool> answer_;
  std::optional<SceneCalibration> found_;
  std::thread thread_;
};

}  // namespace berth::app
