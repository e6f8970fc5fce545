#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "berth/types/image.hpp"
#include "berth/types/joint_state.hpp"
#include "berth/types/robot_image.hpp"
#include "berth/types/status.hpp"
#include "berth/watch/measure_displacement.hpp"
#include "berth/watch/seen_through.hpp"
#include "berth/watch/watch_settings.hpp"

namespace berth {

/// Two-valued state that changes once k of the last n verdicts say so. Verdicts of the old state
/// hold it in the same way: with k above n / 2 both cannot be had at once.
class Agreement {
 public:
  Agreement(int agreeing, int of) : agreeing_(agreeing), last_(static_cast<std::size_t>(of)) {}

  /// As if all verdicts so far had been this one.
  void begin(bool verdict) {
    last_.assign(last_.size(), verdict);
    true_ = verdict ? static_cast<int>(last_.size()) : 0;
    state_ = verdict;
  }
  /// Before n verdicts were given, the missing ones are false.
  void add(bool verdict) {
    true_ += static_cast<int>(verdict) - static_cast<int>(last_[next_]);
    last_[next_] = verdict;
    next_ = (next_ + 1) % last_.size();
    const int against = state_ ? static_cast<int>(last_.size()) - true_ : true_;
    if (against >= agreeing_) state_ = !state_;
  }
  bool state() const { return state_; }

 private:
  int agreeing_;
  std::vector<bool> last_;
  std::size_t next_ = 0;
  int true_ = 0;
  bool state_ = false;
};

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

/// For D less may be hidden than for T, since what hides the robot pulls at the fit.
inline constexpr double kMostHiddenForDisplacement = 0.4;

/// Tells whether one camera stands where it is said to, from the robot in its images. It has moved
/// once T or D says so, and is back once neither does; T and D each by k of their last n verdicts
/// (WatchSettings; two of three for D). A frame that says nothing is no verdict: it neither raises
/// nor clears.
///
/// It also reports, without anything that was learned, that a camera is implausible: the camera
/// sees through nearly all of the robot. The first frame that says something decides at once, so
/// that no answer stands on a mistake of the scene; then k of n frames do. One for each camera,
/// used by one thread.
class PoseWatch {
 public:
  /// Throws std::invalid_argument for settings outside of their domain, and where
  /// max_displacement_m is set and nothing measures D. The thread that measures is there only where
  /// both are given. A camera that another watch of it left as `before` is what it was found to be,
  /// moved or implausible, until as many verdicts say otherwise as after any other frame.
  explicit PoseWatch(const WatchSettings& settings, MeasureDisplacement measure = {},
                     const CameraWatch& before = {});

  /// Judges one frame: the camera's image, the robot as it should be seen in it, the joints at its
  /// exposure. Takes D of an earlier frame where it is there, and begins with this frame's where it
  /// is due, for a camera that stood at X_PC. Allocates nothing after the first frame that D was
  /// begun of.
  const CameraWatch& look(DepthView depth_m, const RobotImage& robot, const JointState& at_exposure,
                          const Pose& X_PC = unset_pose());

  /// A frame that was not observed, since its joints are not known: no verdict.
  const CameraWatch& pass_over();

  /// Waits for D where it is being measured, and takes it: what is told then does not depend on how
  /// long it took. For recordings.
  const CameraWatch& wait();

 private:
  void begin_with(const CameraWatch& before);
  void judge_place(const RobotReadings& readings);
  void tell_place();
  void take_displacement();
  bool is_due(double stamp_s) const;

  WatchSettings settings_;
  CameraWatch state_;
  Agreement by_seen_through_;
  Agreement by_displacement_;
  Agreement by_place_;
  bool has_place_verdict_ = false;
  std::optional<DisplacementCheck> check_;
  std::optional<double> begun_s_;
};

}  // namespace berth
