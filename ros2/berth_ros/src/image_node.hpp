#pragma once

#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <thread>

namespace berth_ros {

/// A plain node beside a lifecycle node, for images: image_transport knows no other, up to ROS 2
/// Jazzy. It has threads of its own, and names of topics that the other node has resolved.
class ImageNode {
 public:
  ImageNode(rclcpp_lifecycle::LifecycleNode& beside, std::size_t threads);
  /// No callback runs any more.
  ~ImageNode();
  ImageNode(const ImageNode&) = delete;
  ImageNode& operator=(const ImageNode&) = delete;

  rclcpp::Node& node() { return *node_; }
  /// From now on callbacks run.
  void spin();

 private:
  rclcpp::Node::SharedPtr node_;
  rclcpp::executors::MultiThreadedExecutor executor_;
  std::thread thread_;
};

}  // namespace berth_ros
