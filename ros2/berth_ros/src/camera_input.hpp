// One camera of a node: its topics, its pose, and the frames made of its images.
#pragma once

#include <image_transport/image_transport.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/camera_info.hpp>
#include <sensor_msgs/msg/image.hpp>
#include <string>

#include "berth/files/camera_info.hpp"
#include "berth/live/live_camera.hpp"
#include "berth/live/raw_depth.hpp"
#include "berth/sensor/rectification.hpp"
#include "callback_gate.hpp"
#include "image_rate.hpp"
#include "node_settings.hpp"
#include "stamp_clock.hpp"
#include "transforms.hpp"

namespace berth_ros {

/// The camera of a camera_info, as berth::read_camera_info reads the same from a file. Throws
/// std::runtime_error as that does.
berth::CameraInfo camera_info_of(const sensor_msgs::msg::CameraInfo& info,
                                 std::optional<bool> is_rectified);

/// Whether both are the same camera in the same place.
bool is_same_mount(const berth::CameraMount& a, const berth::CameraMount& b);

/// The message's pixels, which it keeps.
berth::RawDepth raw_of(const sensor_msgs::msg::Image& image);

/// How a camera stands, for diagnostics and the log.
struct CameraReport {
  /// Why its images are not taken; empty where they are.
  std::string trouble;
  /// Why its pose at an exposure was not known last; empty where it was.
  std::string pose_trouble;
  std::string pose_from;
  berth::LiveCameraCounts counts;
  std::int64_t refused = 0;
  std::int64_t mounts = 0;
  ImageRate rate;
  std::shared_ptr<const berth::Frame> newest;
};

class CameraInput {
 public:
  using ImageMessage = sensor_msgs::msg::Image;
  using OnFrame =
      std::function<void(const std::shared_ptr<const berth::Frame>&, berth::DepthView depth_m,
                         const std::shared_ptr<const ImageMessage>&)>;

  /// `on_frame` is called in the camera's own thread. Images come by `images`, a plain node, since
  /// image_transport knows no other; callbacks of `node` pass `gate`. Frames are placed in
  /// `world_frame` where it is not empty.
  CameraInput(rclcpp_lifecycle::LifecycleNode& node, const std::shared_ptr<CallbackGate>& gate,
              rclcpp::Node& images, CameraSettings settings, std::string world_frame,
              StampClock& clock, const Transforms& transforms, OnFrame on_frame);

  /// From now on frames are of this robot, whose joints these are; null: there is none.
  void use(std::shared_ptr<const berth::Robot> robot,
           std::shared_ptr<const berth::JointIntake> joints, const berth::CameraSettings& settings);
  /// The camera of this mount is implausible whatever its frames say; none: no camera is. Holds
  /// until it is told otherwise, for the robot made anew too.
  void distrust(const std::optional<berth::CameraMount>& mount);
  /// To be called when joint states or transforms came: an image may wait for them.
  void look_again();
  /// Null where there is none of this robot.
  std::shared_ptr<const berth::Frame> newest(const berth::Robot* robot) const;
  const CameraSettings& settings() const { return settings_; }
  CameraReport report() const;

 private:
  /// What a LiveCamera finds its place by, which does not change with it.
  struct PlaceSource {
    /// Empty: the camera stands as the scene file says.
    std::string optical_frame;
    std::string parent_link;
    std::string root_link;
    double max_gap_s = 0;
  };

  void on_info(const std::shared_ptr<const sensor_msgs::msg::CameraInfo>& info);
  void take_info(const sensor_msgs::msg::CameraInfo& info);
  void on_image(const std::shared_ptr<const ImageMessage>& image);
  void take_image(const std::shared_ptr<const ImageMessage>& image);
  /// Throws std::invalid_argument unless image, camera_info and the images before have one frame.
  void require_frame_id(const ImageMessage& image);
  /// Makes live_ where all that it needs is known; else throws std::invalid_argument.
  void make_ready(const ImageMessage& image);
  void find_mount(const ImageMessage& image);
  void mount_at(const berth::CameraMount& mount);
  void make_live(const ImageMessage& image);
  std::unique_ptr<berth::LiveCamera> take_live();
  std::optional<berth::PlaceAtExposure> place_at(const PlaceSource& source, double stamp_s) const;
  berth::CameraWatch found(const berth::CameraMount& mount) const;
  bool is_distrusted(const berth::CameraMount& mount) const {
    return distrusted_ && is_same_mount(*distrusted_, mount);
  }
  void read_image(const ImageMessage& image, berth::DepthImage& depth_m);
  void refuse(const std::string& why);

  CameraSettings settings_;
  std::string world_frame_;
  StampClock& clock_;
  const Transforms& transforms_;
  OnFrame on_frame_;
  mutable std::mutex mutex_;
  std::shared_ptr<const berth::Robot> robot_;
  std::shared_ptr<const berth::JointIntake> joints_;
  /// None where it was refused.
  std::optional<berth::CameraInfo> camera_;
  /// The message that `camera_`, or its refusal, is from.
  std::optional<sensor_msgs::msg::CameraInfo> told_;
  /// None where the images are those of a pinhole camera.
  std::unique_ptr<const berth::Rectification> rectification_;
  /// An image before it is rectified.
  berth::DepthImage given_m_;
  /// Of camera_info; empty where that has none: then the first image decides.
  std::string frame_id_;
  /// The newest one that came before any camera_info.
  std::shared_ptr<const ImageMessage> early_image_;
  std::optional<berth::CameraMount> mount_;
  std::optional<berth::CameraMount> distrusted_;
  /// What the camera of this mount was found to be: for the same one, made anew.
  std::optional<berth::CameraMount> found_mount_;
  berth::CameraWatch found_;
  bool takes_scene_pose_ = false;
  /// TF places the camera image by image.
  bool moves_ = false;
  bool is_known_to_tf_ = false;
  std::string info_trouble_ = "no camera_info yet";
  std::string trouble_ = info_trouble_;
  std::int64_t refused_ = 0;
  std::int64_t mounts_ = 0;
  ImageRate rate_;
  /// Is held where live_ changes, beside mutex_, and by other threads that read it: questions and
  /// joint states do not wait until an image is read.
  mutable std::mutex live_mutex_;
  std::unique_ptr<berth::LiveCamera> live_;
  /// Of a mount that holds no more; to be ended without the mutex.
  std::unique_ptr<berth::LiveCamera> retired_;
  /// Of its own: a LiveCamera asks for places while somebody pushes images into it.
  mutable std::mutex place_mutex_;
  mutable std::string place_trouble_;
  rclcpp::CallbackGroup::SharedPtr group_;
  rclcpp::CallbackGroup::SharedPtr image_group_;
  rclcpp::Subscription<sensor_msgs::msg::CameraInfo>::SharedPtr info_;
  image_transport::Subscriber image_;
};

}  // namespace berth_ros
