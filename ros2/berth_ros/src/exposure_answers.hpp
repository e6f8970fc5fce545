// The robot as it stood at each image's exposure.
#pragma once

#include <berth_msgs/msg/link_distances.hpp>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "berth/pipeline/query.hpp"
#include "live_node.hpp"
#include "stamp_clock.hpp"

namespace berth_ros {

/// One answer for each image, asked in the camera's thread: no other question waits for it.
class ExposureAnswers {
 public:
  /// From now on it is about this robot; null: none.
  void use(std::shared_ptr<const berth::Robot> robot, const std::vector<std::string>& cameras);
  /// A camera's newest frame, with the newest that the others had at that time. False: it is of
  /// another robot.
  bool ask(std::size_t camera, const std::shared_ptr<const berth::Frame>& frame,
           const rclcpp::Time& now, const StampClock& clock,
           berth_msgs::msg::LinkDistances& message);

 private:
  /// Each camera's newest frame of that time: another camera's thread may be ahead.
  LiveFrames frames_at(double stamp_s) const;

  std::mutex mutex_;
  std::shared_ptr<const berth::Robot> robot_;
  std::optional<berth::Query> query_;
  std::vector<std::deque<std::shared_ptr<const berth::Frame>>> recent_;
};

}  // namespace berth_ros
