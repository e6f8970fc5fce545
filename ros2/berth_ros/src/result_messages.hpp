// berth's results as messages.
#pragma once

#include <berth_msgs/msg/link_distances.hpp>
#include <berth_msgs/msg/separation.hpp>
#include <string>
#include <vector>

#include "berth/pipeline/result.hpp"
#include "stamp_clock.hpp"

namespace berth_ros {

/// The fields of a result that was asked for at `now`; but its separation, which has a message of
/// its own. `base_frame` is the robot's root link. Reuses the memory of `out`.
void to_message(const berth::Result& result, const std::string& base_frame, const rclcpp::Time& now,
                const StampClock& clock, berth_msgs::msg::LinkDistances& out);

/// That there is no robot model.
void say_no_robot(const std::vector<std::string>& camera_names, const rclcpp::Time& now,
                  berth_msgs::msg::LinkDistances& out);

/// The least distance of the links that a joint moves. A degraded result has one only with
/// `may_be_degraded`.
void to_message(const berth_msgs::msg::LinkDistances& distances, bool may_be_degraded,
                berth_msgs::msg::Separation& out);

}  // namespace berth_ros
