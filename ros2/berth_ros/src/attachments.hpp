// What the robot has taken up, as services tell it.
#pragma once

#include <berth_msgs/srv/attach.hpp>
#include <berth_msgs/srv/detach.hpp>
#include <functional>
#include <mutex>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <string>
#include <vector>

#include "berth/robot/attachment.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth_ros {

/// The mesh of a shape, in metres and its own frame. Throws std::invalid_argument for a shape that
/// is none of box, sphere and cylinder, or has other sizes than finite ones above 0.
berth::TriangleMesh mesh_of(const shape_msgs::msg::SolidPrimitive& shape);
/// Throws std::invalid_argument for a corner that is not finite, or that the mesh does not have.
berth::TriangleMesh mesh_of(const shape_msgs::msg::Mesh& mesh);

/// Throws std::invalid_argument for a pose whose numbers are not finite or are no rotation.
berth::Pose pose_of(const geometry_msgs::msg::Pose& pose);

/// Throws std::exception that names what was wrong.
berth::Attachment attachment_of(const berth_msgs::srv::Attach::Request& request);

class Attachments {
 public:
  using List = std::vector<berth::Attachment>;
  /// Makes the robot anew with these; throws std::exception, and does nothing, where it cannot.
  using Use = std::function<void(const List&)>;

  /// Offers ~/attach and ~/detach.
  Attachments(rclcpp_lifecycle::LifecycleNode& node, Use use);

  /// What the services told, then what somebody else did.
  List list() const;
  /// Forgets those whose link this robot does not have, and returns their names.
  std::vector<std::string> keep_those_of(const berth::RobotModel& model);
  /// Throw std::exception, and change nothing, where it cannot be.
  void attach(const berth::Attachment& attachment);
  void detach(const std::string& name);
  /// The whole that somebody else has attached, beside what the services did.
  void follow(const List& whole);

 private:
  /// Uses both, and keeps them.
  void change(const List& told, const List& followed);

  Use use_;
  mutable std::mutex mutex_;
  List told_;
  List followed_;
  rclcpp::Service<berth_msgs::srv::Attach>::SharedPtr attach_;
  rclcpp::Service<berth_msgs::srv::Detach>::SharedPtr detach_;
};

}  // namespace berth_ros
