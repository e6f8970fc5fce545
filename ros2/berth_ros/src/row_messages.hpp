// How distances change with the joints, as messages.
#pragma once

#include <berth_msgs/msg/distance_rows.hpp>
#include <berth_msgs/msg/link_distances.hpp>

#include "berth/control/distance_rows.hpp"

namespace berth_ros {

/// The rows of the result that `distances` tell, by joints of the robot's model. Reuses the memory
/// of `out`.
void to_message(const berth::DistanceRows& rows, const std::vector<berth::MovableJoint>& joints,
                const berth_msgs::msg::LinkDistances& distances,
                berth_msgs::msg::DistanceRows& out);

}  // namespace berth_ros
