#pragma once

#include <berth_msgs/msg/link_distances.hpp>
#include <visualization_msgs/msg/marker_array.hpp>

namespace berth_ros {

/// For rviz: for each link a line between its closest points, their ends, and the length; red at 0,
/// yellow at a third of the range, green at the range. What is unknown has a thinner, paler line.
visualization_msgs::msg::MarkerArray markers_of(const berth_msgs::msg::LinkDistances& distances);

}  // namespace berth_ros
