#include "robot_space.hpp"

namespace berth_ros {

RobotSpace::RobotSpace(const LiveRobot& robot, std::size_t cameras, Look look)
    : robot_(robot), look_(std::move(look)), space_(robot_.robot, cameras, *robot_.joints) {
  for (std::size_t k = 0; k < cameras; ++k) take_frame(k);
}

// No other camera's: its own thread may not be done with its newest frame.
void RobotSpace::take_frame(std::size_t camera) { space_.put(camera, look_()[camera]); }

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
