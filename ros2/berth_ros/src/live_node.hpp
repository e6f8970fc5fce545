// What both nodes have: settings, the robot's model and joints, cameras, diagnostics of these.
#pragma once

#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <diagnostic_updater/diagnostic_updater.hpp>
#include <memory>
#include <mutex>
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/joint_state.hpp>
#include <std_msgs/msg/string.hpp>
#include <string>
#include <vector>

#include "camera_input.hpp"
#include "node_settings.hpp"
#include "stamp_clock.hpp"

namespace berth_ros {

/// The newest frame of each camera, or null where it has none yet.
using LiveFrames = std::vector<std::shared_ptr<const berth::Frame>>;

/// The robot and its joints, as they are used at the moment.
struct LiveRobot {
  std::shared_ptr<const berth::Robot> robot;
  std::shared_ptr<berth::JointIntake> joints;
};

class LiveNode : public rclcpp::Node {
 protected:
  LiveNode(const std::string& name, const rclcpp::NodeOptions& options, bool has_one_camera);
  /// Begins to listen. To be called at the end of the constructor of who derives, since callbacks
  /// call what follows.
  void listen();

  /// A frame was observed, in its camera's thread.
  virtual void on_frame(std::size_t camera, const berth::Frame& frame,
                        const std::shared_ptr<const sensor_msgs::msg::Image>& image) = 0;
  virtual void on_joints() {}
  /// The robot is another one, or there is none any more.
  virtual void on_robot() {}

  /// Ends the cameras' threads and what calls back; to be called first by the destructor of who
  /// derives.
  void stop();

  LiveRobot live() const;
  /// None: nothing is monitored.
  std::optional<berth::SeparationSettings> separation_settings() const {
    return settings_.separation();
  }
  /// The newest of each camera of this robot.
  LiveFrames frames(const berth::Robot& robot) const;
  const std::vector<std::string>& camera_names() const { return camera_names_; }
  /// Of a node with one camera.
  const CameraSettings& camera_settings() const { return inputs_.front()->settings(); }

  StampClock clock_;
  diagnostic_updater::Updater diagnostics_;

 private:
  void on_description(const std_msgs::msg::String& description);
  void on_joint_state(const sensor_msgs::msg::JointState& state);
  /// Makes robot and cameras anew of model_ and settings_; or says in robot_trouble_ why not.
  void rebuild();
  void load_model(const std::function<berth::RobotModel()>& load);
  void report_robot(diagnostic_updater::DiagnosticStatusWrapper& status);
  void report_joints(diagnostic_updater::DiagnosticStatusWrapper& status);
  void report_camera(std::size_t camera, diagnostic_updater::DiagnosticStatusWrapper& status);

  NodeSettings settings_;
  std::vector<std::string> camera_names_;
  tf2_ros::Buffer tf_;
  std::unique_ptr<tf2_ros::TransformListener> tf_listener_;

  mutable std::mutex mutex_;
  std::optional<berth::RobotModel> model_;
  std::string description_;
  std::string robot_trouble_ = "no robot_description yet";
  LiveRobot live_;
  std::int64_t joint_messages_ = 0;
  std::int64_t refused_joint_messages_ = 0;
  std::string joint_trouble_ = "no joint state yet";
  std::vector<std::unique_ptr<CameraInput>> inputs_;
  std::vector<std::int64_t> reported_images_;
  std::int64_t reported_joints_ = 0;
  rclcpp::Time reported_joints_at_;
  std::vector<rclcpp::Time> reported_images_at_;

  rclcpp::CallbackGroup::SharedPtr joints_group_;
  rclcpp::CallbackGroup::SharedPtr robot_group_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr description_subscription_;
  rclcpp::Subscription<sensor_msgs::msg::JointState>::SharedPtr joint_subscription_;
  OnSetParametersCallbackHandle::SharedPtr parameters_;
};

}  // namespace berth_ros
