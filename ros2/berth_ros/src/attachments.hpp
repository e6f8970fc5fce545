// What the robot has taken up, as services tell it.
#pragma once

#include <berth_msgs/srv/attach.hpp>
#include <berth_msgs/srv/detach.hpp>
#include <functional>
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

using AttachmentList = std::vector<berth::Attachment>;

/// Forgets links to touch that this robot does not have.
void keep_touched_of(const berth::RobotModel& model, AttachmentList& list);

/// All that is attached.
struct Attached {
  /// By the services.
  AttachmentList told;
  /// By somebody else, whom the node follows.
  AttachmentList followed;

  AttachmentList all() const;
  /// Throws std::invalid_argument where nothing of this name was told.
  void detach(const std::string& name);
  /// Forgets those whose link this robot does not have, and returns their names; and links to
  /// touch that it does not have.
  std::vector<std::string> keep_those_of(const berth::RobotModel& model);
};

/// Makes the robot anew with what this call makes of what is attached. One change at a time.
/// Throws std::exception, and changes nothing, where that cannot be, or the call throws.
using ChangeAttached = std::function<void(const std::function<void(Attached&)>&)>;

/// The services ~/attach and ~/detach.
class Attachments {
 public:
  Attachments(rclcpp_lifecycle::LifecycleNode& node, const ChangeAttached& change);

 private:
  rclcpp::Service<berth_msgs::srv::Attach>::SharedPtr attach_;
  rclcpp::Service<berth_msgs::srv::Detach>::SharedPtr detach_;
};

}  // namespace berth_ros
