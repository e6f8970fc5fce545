// A scene as the messages of a robot and its cameras: what the player and the latency probe share.
#pragma once

#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/camera_info.hpp>
#include <sensor_msgs/msg/image.hpp>
#include <sensor_msgs/msg/joint_state.hpp>
#include <std_msgs/msg/string.hpp>
#include <string>
#include <vector>

#if __has_include(<tf2_ros/static_transform_broadcaster.hpp>)
#include <tf2_ros/static_transform_broadcaster.hpp>
#else
#include <tf2_ros/static_transform_broadcaster.h>
#endif

#include "berth/scene/open_scene.hpp"

namespace berth_ros {

/// A scene that is opened, and asked by time.
class PlayedScene {
 public:
  /// Throws std::runtime_error as open_scene does.
  explicit PlayedScene(const std::string& file);

  const berth::OpenScene& scene() const { return scene_; }
  const berth::SceneFile& file() const { return file_; }
  const berth::JointTrajectory& joints() const { return *scene_.joints; }
  std::size_t cameras() const { return scene_.cameras.size(); }
  /// The image of a camera whose stamp is nearest.
  std::size_t frame_at(std::size_t camera, double time_s) const;
  void joints_at(double time_s, berth::JointState& out) const;

 private:
  berth::SceneFile file_;
  berth::OpenScene scene_;
};

/// Publishes a scene: NAME/depth_image (16UC1) and NAME/camera_info, joint_states; and, once made,
/// robot_description, whose meshes have the names of files, and the cameras' poses on /tf_static.
class SceneMessages {
 public:
  SceneMessages(rclcpp::Node& node, const PlayedScene& scene);

  void publish_image(std::size_t camera, std::size_t frame, const rclcpp::Time& stamp);
  void publish_joints(const berth::JointState& joints, const rclcpp::Time& stamp);

 private:
  struct Camera {
    rclcpp::Publisher<sensor_msgs::msg::Image>::SharedPtr image;
    rclcpp::Publisher<sensor_msgs::msg::CameraInfo>::SharedPtr info;
    std::vector<sensor_msgs::msg::Image> images;
    sensor_msgs::msg::CameraInfo camera_info;
  };

  void add_camera(rclcpp::Node& node, const berth::OpenCamera& camera);

  tf2_ros::StaticTransformBroadcaster transforms_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr description_;
  rclcpp::Publisher<sensor_msgs::msg::JointState>::SharedPtr joints_;
  sensor_msgs::msg::JointState joint_state_;
  std::vector<geometry_msgs::msg::TransformStamped> mounts_;
  std::vector<Camera> cameras_;
};

}  // namespace berth_ros
