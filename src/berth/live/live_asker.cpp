#include "berth/live/live_asker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace berth {
namespace {

double newest_stamp_s(const LiveFrames& frames) {
  double newest_s = -std::numeric_limits<double>::infinity();
  for (const auto& frame : frames) {
    if (frame) newest_s = std::max(newest_s, frame->stamp_s);
  }
  return newest_s;
}

}  // namespace

LiveAsker::LiveAsker(std::shared_ptr<const Robot> robot, std::size_t camera_count)
    : robot_(std::move(robot)), asker_(robot_), pointers_(camera_count), none_{} {
  if (camera_count == 1 || has_mesh()) return;
  throw std::invalid_argument(fmt::format("method {} looks at one camera, and there are {}; "
                                          "expected mesh",
                                          name_of(robot_->settings().method), camera_count));
}

void LiveAsker::look(const LiveFrames& frames, double now_s) {
  const TimeSettings& settings = robot_->settings().time;
  before_.swap(cameras_);
  cameras_.clear();
  for (const auto& frame : frames) cameras_.push_back(camera_state(frame.get(), now_s, settings));
  const bool same_states = std::equal(
      cameras_.begin(), cameras_.end(), before_.begin(), before_.end(),
      [](const CameraState& a, const CameraState& b) { return a.status == b.status; });
  if (same_states && frames == frames_) return;
  frames_ = frames;
  if (!has_mesh()) return;
  for (std::size_t k = 0; k < frames.size(); ++k) pointers_[k] = frames[k].get();
  set_.assign(pointers_, settings, now_s);
}

const Frame& LiveAsker::only_frame() const { return frames_[0] ? *frames_[0] : none_; }

const Answer& LiveAsker::ask(const LiveFrames& frames, const JointBuffer& joints, double now_s) {
  look(frames, now_s);
  return has_mesh() ? asker_.ask(set_, joints, now_s) : asker_.ask(only_frame(), joints, now_s);
}

const Answer& LiveAsker::ask(const LiveFrames& frames, const JointState& joints,
                             std::optional<double> now_s) {
  look(frames, now_s.value_or(newest_stamp_s(frames)));
  return has_mesh() ? asker_.ask(set_, joints, now_s) : asker_.ask(only_frame(), joints, now_s);
}

const Answer& LiveAsker::ask_at_exposure(const LiveFrames& frames, std::optional<double> now_s) {
  look(frames, now_s.value_or(newest_stamp_s(frames)));
  return has_mesh() ? asker_.ask(set_, now_s) : asker_.ask(only_frame(), now_s);
}

}  // namespace berth
