// What MoveIt has attached to the robot, where moveit_msgs is installed.
#pragma once

#include <moveit_msgs/msg/planning_scene.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <vector>

#include "attachments.hpp"

namespace berth_ros {

/// The parts of one object, each as a link of its own: called like the object where it has one
/// shape, else NAME/0, NAME/1, ... They may touch its touch_links. Throws std::invalid_argument for
/// a pose in another frame than that of its link, for a shape without a pose, and for a plane.
AttachmentList attachments_of(const moveit_msgs::msg::AttachedCollisionObject& object);

/// Follows the topic `monitored_planning_scene`.
class MoveItAttached {
 public:
  MoveItAttached(rclcpp_lifecycle::LifecycleNode& node, ChangeAttached change);

 private:
  using Object = moveit_msgs::msg::AttachedCollisionObject;
  void take(const moveit_msgs::msg::PlanningScene& scene);
  void follow(const std::vector<Object>& objects);

  rclcpp::Logger logger_;
  ChangeAttached change_;
  /// As MoveIt told them last, without their stamps.
  std::vector<Object> objects_;
  rclcpp::Subscription<moveit_msgs::msg::PlanningScene>::SharedPtr subscription_;
};

}  // namespace berth_ros
