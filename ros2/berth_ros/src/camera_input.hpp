// One camera of a node: its topics, its pose, and the frames made of its images.
#pragma once

#include <tf2_ros/buffer.h>
#include <image_transport/image_transport.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/camera_info.hpp>
#include <sensor_msgs/msg/image.hpp>
#include <string>

#include "berth/live/live_camera.hpp"
#include "berth/live/raw_depth.hpp"
#include "node_settings.hpp"
#include "stamp_clock.hpp"

namespace berth_ros {

/// The pinhole camera of a camera_info. Throws std::invalid_argument where it is none: without
/// intrinsics, with distortion unless `is_rectified`, with binning or a region of interest.
berth::Camera camera_of(const sensor_msgs::msg::CameraInfo& info, bool is_rectified);

/// The message's pixels, which it keeps.
berth::RawDepth raw_of(const sensor_msgs::msg::Image& image);

/// How a camera stands, for diagnostics.
struct CameraReport {
  /// Empty where all is well.
  std::string trouble;
  std::string pose_from;
  berth::LiveCameraCounts counts;
  std::int64_t refused = 0;
  std::int64_t mounts = 0;
  std::shared_ptr<const berth::Frame> newest;
};

class CameraInput {
 public:
  using ImageMessage = sensor_msgs::msg::Image;
  using OnFrame =
      std::function<void(const berth::Frame&, const std::shared_ptr<const ImageMessage>&)>;

  /// `on_frame` is called in the camera's own thread.
  CameraInput(rclcpp::Node& node, CameraSettings settings, StampClock& clock,
              const tf2_ros::Buffer& tf, OnFrame on_frame);

  /// From now on frames are of this robot, whose joints these are; null: there is none.
  void use(std::shared_ptr<const berth::Robot> robot,
           std::shared_ptr<const berth::JointIntake> joints, const berth::CameraSettings& view);
  void joints_came();
  /// Null where there is none of this robot.
  std::shared_ptr<const berth::Frame> newest(const berth::Robot* robot) const;
  const CameraSettings& settings() const { return settings_; }
  CameraReport report() const;

 private:
  void on_info(const std::shared_ptr<const sensor_msgs::msg::CameraInfo>& info);
  void take_info(const sensor_msgs::msg::CameraInfo& info);
  void on_image(const std::shared_ptr<const ImageMessage>& image);
  void take_image(const std::shared_ptr<const ImageMessage>& image);
  /// Makes live_ where all that it needs is known; else says in trouble_ what is not.
  bool make_ready(const ImageMessage& image);
  bool find_mount(const ImageMessage& image);
  void refuse(const std::string& why);

  rclcpp::Logger logger_;
  CameraSettings settings_;
  StampClock& clock_;
  const tf2_ros::Buffer& tf_;
  OnFrame on_frame_;
  mutable std::mutex mutex_;
  std::shared_ptr<const berth::Robot> robot_;
  std::shared_ptr<const berth::JointIntake> joints_;
  std::optional<berth::Camera> camera_;
  /// The newest one that came before any camera_info.
  std::shared_ptr<const ImageMessage> early_image_;
  std::optional<berth::CameraMount> mount_;
  bool takes_scene_pose_ = false;
  std::string trouble_ = "no camera_info yet";
  std::int64_t refused_ = 0;
  std::int64_t mounts_ = 0;
  std::unique_ptr<berth::LiveCamera> live_;
  /// Of a mount that holds no more; to be ended without the mutex.
  std::unique_ptr<berth::LiveCamera> retired_;
  rclcpp::CallbackGroup::SharedPtr group_;
  rclcpp::Subscription<sensor_msgs::msg::CameraInfo>::SharedPtr info_;
  image_transport::Subscriber image_;
};

}  // namespace berth_ros
