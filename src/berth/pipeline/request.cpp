#include "berth/pipeline/request.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace berth {

void NewestFrames::require_count(std::size_t count) {
  if (count >= 1 && count <= kMostCameras) return;
  throw std::invalid_argument(
      fmt::format("frames: {} cameras; expected 1 to {}", count, kMostCameras));
}

const JointState* RequestedJoints::read(std::optional<double> now_s, JointState& newest,
                                        TimeStatus& status) const {
  status = status_;
  if (!buffer_) return state_;
  if (!now_s) {
    throw std::invalid_argument(
        "now_s: none; expected the time of the request, since joints are a buffer");
  }
  status = buffer_->newest(newest);
  const bool is_ahead = newest.stamp_s > *now_s + kMostJointsAhead_s;
  if (status == TimeStatus::ok && is_ahead) status = TimeStatus::stale_joints;
  return &newest;
}

}  // namespace berth
