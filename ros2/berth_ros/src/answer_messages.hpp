// berth's answers as messages.
#pragma once

#include <berth_msgs/msg/link_distances.hpp>
#include <berth_msgs/msg/separation.hpp>
#include <string>
#include <vector>

#include "berth/live/live_asker.hpp"
#include "stamp_clock.hpp"

namespace berth_ros {

/// What an answer's message needs besides the answer.
struct AnswerContext {
  const berth::Robot& robot;
  const std::vector<std::string>& camera_names;
  /// LiveAsker's, of the same question.
  const std::vector<berth::CameraState>& cameras;
  const berth::LiveFrames& frames;
  StampClock& clock;
  /// The time of the question.
  rclcpp::Time now;
};

/// Points are in the robot's root frame. Reuses the memory of `out`.
void to_message(const berth::Answer& answer, const AnswerContext& context,
                berth_msgs::msg::LinkDistances& out);

/// That there is no robot model.
void say_no_robot(const std::vector<std::string>& camera_names, const rclcpp::Time& now,
                  berth_msgs::msg::LinkDistances& out);

/// The least distance of the links that a joint moves.
void to_message(const berth_msgs::msg::LinkDistances& distances, berth_msgs::msg::Separation& out);

}  // namespace berth_ros
