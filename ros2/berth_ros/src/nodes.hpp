// The nodes, for programs of their own; a component container finds them by name.
#pragma once

#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>

namespace berth_ros {

/// Each throws std::exception for a bad file or parameter.
std::shared_ptr<rclcpp_lifecycle::LifecycleNode> make_distance_node(
    const rclcpp::NodeOptions& options);
std::shared_ptr<rclcpp_lifecycle::LifecycleNode> make_self_filter_node(
    const rclcpp::NodeOptions& options);
std::shared_ptr<rclcpp::Node> make_scene_player_node(const rclcpp::NodeOptions& options);
std::shared_ptr<rclcpp::Node> make_latency_probe_node(const rclcpp::NodeOptions& options);

}  // namespace berth_ros
