#include "berth/pipeline/frame_set.hpp"

#include <algorithm>
#include <cassert>

#include "berth/pipeline/frame_space.hpp"
#include "berth/pipeline/mounted_camera.hpp"
#include "berth/space/unknown_space.hpp"

namespace berth {
namespace {

/// In the root where it stands at X_WB now. One that did not move keeps its numbers to the bit.
Pose posed_now(const Frame& frame, const Pose& X_WB) {
  if (X_WB.matrix() == frame.X_WB.matrix()) return frame.X_BC;
  return X_WB.inverse() * frame.X_WB * frame.X_BC;
}

}  // namespace

void FrameSet::assign(std::span<const Frame* const> frames, const TimeSettings& settings,
                      std::optional<double> now_s, const std::optional<Pose>& X_WB,
                      const FrameSet* aged) {
  frames_.assign(frames.begin(), frames.end());
  cameras_.clear();
  used_.clear();
  posed_.clear();
  posed_rejected_.clear();
  newest_ = nullptr;
  double newest_s = -std::numeric_limits<double>::infinity();
  for (const Frame* frame : frames_) {
    if (frame && frame->mounted) newest_s = std::max(newest_s, frame->stamp_s);
  }
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    cameras_.push_back(camera_state(frames_[k], now_s.value_or(newest_s), settings));
    if (!is_used(cameras_[k].status)) continue;
    used_.push_back(static_cast<int>(k));
    if (!newest_ || frames_[k]->stamp_s > newest_->stamp_s) newest_ = frames_[k];
  }
  X_BC_.assign(frames_.size(), unset_pose());
  for (const int k : used_) {
    const Frame& frame = *frames_[k];
    X_BC_[k] = posed_now(frame, X_WB.value_or(newest_->X_WB));
    assert(!frame.space->seen.is_empty());
    // Of age without end: its readings count, and it frees nothing.
    const double age_s = cameras_[k].status == CameraStatus::blind
                             ? std::numeric_limits<double>::infinity()
                             : newest_->stamp_s - frame.stamp_s;
    posed_.push_back({&frame.space->seen, X_BC_[k], age_s});
    if (frame.space->has_rejected_space)
      posed_rejected_.push_back({&frame.space->rejected_space, X_BC_[k], 0});
  }
  space_.assign(posed_, aged ? &aged->space_ : nullptr,
                newest_ ? std::span(newest_->mounted->robot()->model().guarded)
                        : std::span<const GuardedBox>());
  rejected_.assign(posed_rejected_);
  find_undecided_readings();
}

void FrameSet::find_undecided_readings() {
  const std::size_t count = used_.size();
  undecided_m_.resize(std::max(undecided_m_.size(), count));
  undecided_spaces_.resize(undecided_m_.size());
  posed_.clear();
  undecided_places_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const Frame& frame = *frames_[used_[i]];
    if (frame.obstacles.count_of(PixelFate::flying_patch) == 0 || count < 2) continue;
    if (!find_undecided(space_.views(), i, frame.obstacles.fate, undecided_m_[i])) continue;
    build_reading_space(frame.mounted->camera(), undecided_m_[i], frame.mounted->settings().space,
                        undecided_spaces_[i]);
    posed_.push_back({&undecided_spaces_[i], X_BC_[used_[i]], 0});
    undecided_places_.push_back(static_cast<int>(i));
  }
  undecided_.assign(posed_);
}

bool FrameSet::is_posed_at(const Pose& X_WB) const {
  return !newest_ || X_WB.matrix() == newest_->X_WB.matrix();
}

Timeliness timeliness_of(const FrameSet& frames, std::optional<double> now_s,
                         const TimeSettings& settings) {
  if (frames.newest()) return timeliness_of(*frames.newest(), now_s, settings);
  Timeliness time;
  time.status = TimeStatus::no_frame;
  double newest_s = -std::numeric_limits<double>::infinity();
  for (const CameraState& camera : frames.cameras()) {
    if (camera.status == CameraStatus::no_frame || !(camera.stamp_s >= newest_s)) continue;
    newest_s = camera.stamp_s;
    time.status = camera.status == CameraStatus::too_old ? TimeStatus::stale_frame : camera.time;
    if (now_s) time.frame_age_s = time.joints_age_s = *now_s - camera.stamp_s;
  }
  return time;
}

Timeliness timeliness_of(const FrameSet& frames, double joints_stamp_s, std::optional<double> now_s,
                         const TimeSettings& settings) {
  if (frames.newest()) return timeliness_of(*frames.newest(), joints_stamp_s, now_s, settings);
  Timeliness time = timeliness_of(frames, now_s, settings);
  if (now_s) time.joints_age_s = *now_s - joints_stamp_s;
  return time;
}

}  // namespace berth
