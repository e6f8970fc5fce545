#pragma once

#include <optional>
#include <span>
#include <vector>

#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/timeliness.hpp"
#include "berth/space/unknown_space.hpp"
#include "berth/types/status.hpp"

namespace berth {

/// The newest frame of each camera, as requests see them: which of them are
/// used, and the space that they leave. Assigned at the cameras' clock; then any number of askers
/// may ask it, and what one of them finds out about unknown space is kept for all.
class FrameSet {
 public:
  /// Camera k's newest frame, or null where it has none yet. Each belongs to another MountedCamera
  /// of one robot, and has to outlive the requests. A frame that is stale,
  /// of a camera that moved or is implausible, or too old at `now_s`, is left out: its readings are
  /// not known any more, and what it would have seen free is hidden again. Without now_s the newest
  /// stamp is taken for now. X_WB is where the robot's root stands in the requests; none: where it
  /// stood at the newest exposure that is used. Nobody may ask meanwhile. Reuses its memory.
  /// What `aged` has of the same frames at the same ages is taken from it, which then has to
  /// outlive the requests.
  void assign(std::span<const Frame* const> frames, const TimeSettings& settings,
              std::optional<double> now_s = {}, const std::optional<Pose>& X_WB = {},
              const FrameSet* aged = nullptr);

  /// Whether it would be the same with this X_WB.
  bool is_posed_at(const Pose& X_WB) const;

  /// frames()[k] and cameras()[k] belong to camera k.
  std::span<const Frame* const> frames() const { return frames_; }
  const std::vector<CameraState>& cameras() const { return cameras_; }
  /// Of all that are used; null where none is.
  const Frame* newest() const { return newest_; }
  /// Where camera k stood, in the root link as the requests have it. Unset unless it is used.
  const Pose& X_BC(std::size_t k) const { return X_BC_[k]; }
  /// Its view i is frames()[used()[i]].
  const UnknownSpace& space() const { return space_; }
  const std::vector<int>& used() const { return used_; }
  /// Flying patches that another camera frees by a rule alone (find_undecided()): readings that are
  /// unknown space for all. Without views where there are none.
  const UnknownSpace& undecided() const { return undecided_; }
  /// The place of its view i among used().
  int place_of_undecided(int i) const { return undecided_places_[i]; }
  /// What was dropped as rejected, as a space of its own; without views where nothing was.
  const UnknownSpace& rejected() const { return rejected_; }

 private:
  void find_undecided_readings();

  std::vector<const Frame*> frames_;
  std::vector<CameraState> cameras_;
  std::vector<int> used_;
  std::vector<Pose> X_BC_;
  std::vector<PosedSpace> posed_;
  std::vector<PosedSpace> posed_rejected_;
  const Frame* newest_ = nullptr;
  UnknownSpace space_;
  UnknownSpace rejected_;
  UnknownSpace undecided_;
  /// Of each camera that is used.
  std::vector<DepthImage> undecided_m_;
  std::vector<CameraSpace> undecided_spaces_;
  std::vector<int> undecided_places_;
};

/// How an answer stands at `now_s` for the joints of the newest frame that is used. Where none is,
/// the status is that of the newest of all.
Timeliness timeliness_of(const FrameSet& frames, std::optional<double> now_s,
                         const TimeSettings& settings);

/// The same for joints of another stamp.
Timeliness timeliness_of(const FrameSet& frames, double joints_stamp_s, std::optional<double> now_s,
                         const TimeSettings& settings);

}  // namespace berth
