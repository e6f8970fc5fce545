#include "robot_space.hpp"

namespace berth_ros {

RobotSpace::RobotSpace(const LiveRobot& robot, std::size_t cameras, Look look)
    : robot_(robot), look_(std::move(look)), space_(robot_.robot, cameras, *robot_.joints) {
  take_frames();
}

void RobotSpace::take_frames() {
  const std::lock_guard lock(mutex_);
  const LiveFrames frames = look_();
  for (std::size_t k = 0; k < frames.size(); ++k) space_.put(k, frames[k]);
}

std::shared_ptr<const berth::PreparedSpace> RobotSpace::ready(const LiveFrames& now) const {
  auto prepared = space_.newest();
  const auto frames = prepared->frames();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (!frames[k]) continue;
    if (!now[k] || now[k]->view != frames[k]->view) return nullptr;
  }
  return prepared;
}

}  // namespace berth_ros
