#pragma once

#include <array>
#include <cassert>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>

#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/prepared_space.hpp"
#include "berth/robot/joint_buffer.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// How many cameras a request may have.
inline constexpr std::size_t kMostCameras = 8;

/// How far a buffer's newest joints may lie after the request: a simulation's clock may tick 40
/// times a second, and its joints come between. Farther ahead they are of another clock, or of one
/// that was set back, and nobody knows how old they are.
inline constexpr double kMostJointsAhead_s = 0.04;

/// The newest frame of each camera, or null where a camera has given none yet. It refers to them.
class NewestFrames {
 public:
  NewestFrames(const Frame& only) : count_(1) { frames_[0] = &only; }
  NewestFrames(std::span<const Frame* const> frames) { assign(frames); }
  NewestFrames(std::span<const std::shared_ptr<const Frame>> frames) { assign(frames); }
  NewestFrames(const std::vector<const Frame*>& frames) { assign(frames); }
  NewestFrames(const std::vector<std::shared_ptr<const Frame>>& frames) { assign(frames); }
  /// All that can be done beforehand is done.
  NewestFrames(std::shared_ptr<const PreparedSpace> prepared) : prepared_(std::move(prepared)) {
    assign(prepared_->frames());
  }

  std::span<const Frame* const> get() const { return {frames_.data(), count_}; }
  /// Null unless it was made of one.
  const std::shared_ptr<const PreparedSpace>& prepared() const { return prepared_; }

 private:
  /// Throws std::invalid_argument unless there are 1 to kMostCameras.
  static void require_count(std::size_t count);
  template <class Frames>
  void assign(const Frames& frames) {
    require_count(frames.size());
    for (const auto& frame : frames) frames_[count_++] = frame ? &*frame : nullptr;
  }

  std::array<const Frame*, kMostCameras> frames_ = {};
  std::size_t count_ = 0;
  std::shared_ptr<const PreparedSpace> prepared_;
};

/// The joints that are asked about: those of the newest exposure that is used, any others, or the
/// newest of a buffer, whose trouble is a status. It refers to them.
class RequestedJoints {
 public:
  RequestedJoints() = default;
  RequestedJoints(const JointState& state) : state_(&state) {}
  RequestedJoints(const JointBuffer& buffer) : buffer_(&buffer) {}
  /// Those that a buffer gave, with what it said of them.
  RequestedJoints(const JointState& state, TimeStatus status) : state_(&state), status_(status) {}

  /// Those that a request at `now_s` is about: null for those of the exposure. A buffer's newest
  /// are written to `newest`, with how they stand in `status`: stale_joints where they lie more
  /// than kMostJointsAhead_s after it. Throws std::invalid_argument for a buffer without a time.
  const JointState* read(std::optional<double> now_s, JointState& newest, TimeStatus& status) const;

 private:
  const JointState* state_ = nullptr;
  TimeStatus status_ = TimeStatus::ok;
  const JointBuffer* buffer_ = nullptr;
};

/// One request over all cameras.
struct Request {
  NewestFrames frames;
  RequestedJoints joints = {};
  /// The time of the request: ages are told and judged by TimeSettings. Without it no age is known,
  /// and the frames are judged at the newest of their stamps. A JointBuffer needs it.
  std::optional<double> now_s = std::nullopt;
  /// Where the robot's root stands in the frame of PlaceAtExposure::X_WB; none: where it stood at
  /// the newest exposure that is used. With a pose that is not finite the result is stale_pose.
  std::optional<Pose> X_WB = std::nullopt;
  /// Joint angles that the robot may take next: Result::ahead reports their distances.
  std::span<const JointState> ahead = {};
  /// Result::ahead reports the first of these poses that may be nearer than this.
  double nearer_than_m = 0;
  /// Ends the search within milliseconds once it is asked to stop, as a deadline would: a link that
  /// is not done is LinkStatus::cut_short, or its bounds are apart. For who waits for a request
  /// over a large range.
  std::stop_token stop = {};
};

}  // namespace berth
