// Attaching and detaching as actions, which end once answers know of it.
#pragma once

#include <berth_msgs/action/attach.hpp>
#include <berth_msgs/action/detach.hpp>
#include <functional>
#include <rclcpp_action/rclcpp_action.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <string>
#include <vector>

#include "attachments.hpp"

namespace berth_ros {

/// The actions ~/attach_part and ~/detach_part. All their callbacks are in the node's own callback
/// group: one at a time.
class AttachActions {
 public:
  /// The names of the cameras that have no image of the newest robot yet.
  using Waiting = std::function<std::vector<std::string>()>;

  AttachActions(rclcpp_lifecycle::LifecycleNode& node, ChangeAttached change, Waiting waiting);

 private:
  using Attach = berth_msgs::action::Attach;
  using Detach = berth_msgs::action::Detach;
  /// A goal whose robot is made, until images of it came: reports its feedback or its end to the
  /// client, and returns whether it has ended.
  using Pending = std::function<bool(const std::vector<std::string>& waiting_for)>;

  template <class Action>
  typename rclcpp_action::Server<Action>::SharedPtr serve(rclcpp_lifecycle::LifecycleNode& node,
                                                          const std::string& name);
  template <class Action>
  void begin(const std::shared_ptr<rclcpp_action::ServerGoalHandle<Action>>& goal);
  void look();

  ChangeAttached change_;
  Waiting waiting_;
  std::vector<Pending> pending_;
  rclcpp_action::Server<Attach>::SharedPtr attach_;
  rclcpp_action::Server<Detach>::SharedPtr detach_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace berth_ros
