// What questions are asked of: all that images need is done before, in a thread of its own.
#pragma once

#include <functional>
#include <memory>

#include "berth/live/live_space.hpp"
#include "live_node.hpp"

namespace berth_ros {

/// What the cameras of one robot leave of space, made ready as images come.
class RobotSpace {
 public:
  /// The newest frame of each camera of this robot.
  using Look = std::function<LiveFrames()>;

  RobotSpace(const LiveRobot& robot, std::size_t cameras, Look look);

  /// Takes the camera's newest frame: to be called by its thread, when it has come. Returns at
  /// once.
  void take_frame(std::size_t camera);
  /// What is ready; null where a camera does not stand for its frame in it any more, since it is
  /// another one, or elsewhere.
  std::shared_ptr<const berth::PreparedSpace> ready(const LiveFrames& now) const;
  berth::LiveSpaceCounts counts() const { return space_.counts(); }

 private:
  LiveRobot robot_;
  Look look_;
  berth::LiveSpace space_;
};

}  // namespace berth_ros
