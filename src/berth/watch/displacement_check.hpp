#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "berth/types/image.hpp"
#include "berth/types/joint_state.hpp"
#include "berth/watch/measure_displacement.hpp"

namespace berth {

/// Measures D in the background, of one frame at a time.
class DisplacementCheck {
 public:
  explicit DisplacementCheck(MeasureDisplacement measure);

  /// Begins with copies of these, in memory that is made once. False, and nothing else, while one
  /// is measured, or its result was not taken.
  bool start(DepthView depth_m, const JointState& at_exposure, const Pose& X_PC);

  /// The result once it is there, once: the inner one is none where the frame did not tell.
  std::optional<std::optional<double>> take();

  /// Returns when nothing is measured.
  void wait();

 private:
  enum class Step { idle, asked, done };

  void run(const std::stop_token& stop);

  MeasureDisplacement measure_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  Step step_ = Step::idle;
  /// The thread's while a frame is measured, else the others'.
  DepthImage depth_m_;
  JointState at_exposure_;
  Pose X_PC_ = Pose::Identity();
  std::optional<double> result_;
  /// The last member: it ends before the others do.
  std::jthread thread_;
};

}  // namespace berth
