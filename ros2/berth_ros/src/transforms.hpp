// TF as a node hears it.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <string>
#include <tf2_msgs/msg/tf_message.hpp>
#include <vector>

#if __has_include(<tf2_ros/buffer.hpp>)
#include <tf2_ros/buffer.hpp>
#else
#include <tf2_ros/buffer.h>
#endif

#include "berth/live/joint_intake.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/types/camera.hpp"
#include "callback_gate.hpp"

namespace berth_ros {

/// A pose that TF told.
struct ToldPose {
  berth::Pose X_PF;
  /// No frame between the two ever moves.
  bool is_static = false;
  /// Of the transform; 0 where it is static.
  rclcpp::Time stamp = rclcpp::Time(0, 0, RCL_ROS_TIME);
};

/// TF, with the times at which each frame that moves was told: tf2 interpolates over any gap, and
/// what moves may have been anywhere within a long one.
class Transforms {
 public:
  /// `on_change` is called after each message, and `on_set_back` where the time of a frame that is
  /// used went back, in a callback of the node that has passed `gate`.
  Transforms(rclcpp_lifecycle::LifecycleNode& node, const std::shared_ptr<CallbackGate>& gate,
             std::function<void()> on_change,
             std::function<void(const std::string& frame)> on_set_back);

  /// Forgets all that moves.
  void forget();

  /// Where `frame` was in `parent` at a time; none where TF does not enclose that time, or a frame
  /// that moves was told at no time within max_gap_s of it. `why` then says it.
  std::optional<ToldPose> at(const std::string& parent, const std::string& frame,
                             const rclcpp::Time& stamp, double max_gap_s, std::string& why) const;

  /// The same as it was told last, however long ago.
  std::optional<ToldPose> newest(const std::string& parent, const std::string& frame,
                                 std::string& why) const;

  /// The first link of the robot above this frame in TF's tree (the hand, for a camera there), else
  /// the robot's root.
  std::string link_above(const berth::RobotModel& model, const std::string& frame) const;

 private:
  /// The newest stamps of a frame that moves, in ns, increasing.
  struct Told {
    std::deque<std::int64_t> stamps_ns;
    berth::BehindNewest behind;
    /// A place was asked for that depends on it.
    bool is_used = false;
  };

  void take(const tf2_msgs::msg::TFMessage& message, bool is_static);
  void take(const geometry_msgs::msg::TransformStamped& transform, bool is_static);
  /// Of a frame that anybody asks for.
  bool is_set_back(const std::string& frame, std::int64_t stamp_ns);
  /// The frames between the two that move.
  std::vector<std::string> moving_between(const std::string& parent,
                                          const std::string& frame) const;
  std::vector<std::string> ancestors(std::string frame) const;
  double gap_s(const std::string& frame, const rclcpp::Time& stamp) const;

  tf2_ros::Buffer buffer_;
  std::function<void()> on_change_;
  std::function<void(const std::string&)> on_set_back_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, Told> told_;
  rclcpp::Subscription<tf2_msgs::msg::TFMessage>::SharedPtr moving_;
  rclcpp::Subscription<tf2_msgs::msg::TFMessage>::SharedPtr static_;
};

/// Whether both are the same place, to a tenth of a millimetre and 0.0001 rad.
bool is_same_place(const berth::Pose& a, const berth::Pose& b);

}  // namespace berth_ros
