// Plays a scene in real time, as a robot and its cameras would: images, camera_info, joint states,
// robot_description, and the cameras' poses as static transforms.
#include <algorithm>
#include <fstream>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>
#include <regex>
#include <sensor_msgs/image_encodings.hpp>
#include <sensor_msgs/msg/camera_info.hpp>
#include <sensor_msgs/msg/image.hpp>
#include <sensor_msgs/msg/joint_state.hpp>
#include <sstream>
#include <std_msgs/msg/string.hpp>
#include <tf2_eigen/tf2_eigen.hpp>
#include <tf2_ros/static_transform_broadcaster.h>

#include "berth/files/depth_units.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth_ros {
namespace {

using sensor_msgs::msg::CameraInfo;
using sensor_msgs::msg::Image;
using sensor_msgs::msg::JointState;

/// From one round to the next, so that no stamp comes twice.
constexpr double kBetweenRounds_s = 0.1;

std::string frame_of(const berth::OpenCamera& camera) {
  return camera.source.name + "_optical_frame";
}

/// Whose meshes anybody can find.
std::string urdf_with_file_names(const berth::SceneFile& scene) {
  std::ostringstream text;
  text << std::ifstream(scene.robot.urdf).rdbuf();
  std::string urdf = text.str();
  for (const auto& [name, folder] : scene.robot.package_paths) {
    const std::string path = std::filesystem::canonical(folder).string();
    urdf = std::regex_replace(urdf, std::regex("package://" + name + "/"), "file://" + path + "/");
  }
  return urdf;
}

CameraInfo info_of(const berth::Camera& camera) {
  CameraInfo info;
  info.width = static_cast<std::uint32_t>(camera.width_px);
  info.height = static_cast<std::uint32_t>(camera.height_px);
  info.distortion_model = "plumb_bob";
  info.d.assign(5, 0.0);
  info.k = {camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1};
  info.r = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.p = {camera.fx_px, 0, camera.cx_px, 0, 0, camera.fy_px, camera.cy_px, 0, 0, 0, 1, 0};
  return info;
}

Image image_of(const berth::DepthImage& depth_m, double scale_m, double offset_m) {
  Image image;
  image.width = static_cast<std::uint32_t>(depth_m.width());
  image.height = static_cast<std::uint32_t>(depth_m.height());
  image.encoding = sensor_msgs::image_encodings::TYPE_16UC1;
  image.step = image.width * 2;
  image.data.resize(std::size_t{image.step} * image.height);
  auto* to = image.data.data();
  for (const float z_m : depth_m.pixels()) {
    const std::uint16_t number = berth::number_of(static_cast<float>(z_m - offset_m), scale_m);
    *to++ = static_cast<std::uint8_t>(number & 0xFF);
    *to++ = static_cast<std::uint8_t>(number >> 8);
  }
  return image;
}

}  // namespace

class ScenePlayerNode : public rclcpp::Node {
 public:
  explicit ScenePlayerNode(const rclcpp::NodeOptions& options)
      : Node("scene_player_node", options), transforms_(this) {
    const berth::SceneFile file = berth::read_scene(declare_parameter<std::string>("scene"));
    does_loop_ = declare_parameter("loop", true);
    scene_ = berth::open_scene(file);
    description_ = create_publisher<std_msgs::msg::String>(
        "robot_description", rclcpp::QoS(1).transient_local().reliable());
    std_msgs::msg::String description;
    description.data = urdf_with_file_names(file);
    description_->publish(description);
    joints_ = create_publisher<JointState>("joint_states", rclcpp::QoS(50));
    for (const berth::MovableJoint& joint : scene_.robot->model().joints) {
      joint_state_.name.push_back(joint.name);
    }
    for (const berth::OpenCamera& camera : scene_.cameras) add_camera(camera);
    plan();
    start_ = now() + rclcpp::Duration::from_seconds(declare_parameter("start_after_s", 1.0));
    timer_ = create_wall_timer(std::chrono::milliseconds(1), [this] { play(); });
  }

 private:
  /// What is published at a time: a joint sample, or an image.
  struct Event {
    double time_s;
    int camera;  // -1: a joint sample
    std::size_t index;
  };
  struct Camera {
    rclcpp::Publisher<Image>::SharedPtr image;
    rclcpp::Publisher<CameraInfo>::SharedPtr info;
    std::vector<Image> images;
    CameraInfo camera_info;
  };

  void add_camera(const berth::OpenCamera& camera) {
    const std::string& name = camera.source.name;
    const rclcpp::QoS qos = rclcpp::SensorDataQoS().reliable();
    Camera& made = cameras_.emplace_back();
    made.image = create_publisher<Image>(name + "/depth_image", qos);
    made.info = create_publisher<CameraInfo>(name + "/camera_info", qos);
    made.camera_info = info_of(camera.view->camera());
    made.camera_info.header.frame_id = frame_of(camera);
    for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
      made.images.push_back(image_of(camera.read_depth(i), camera.source.depth_scale_m,
                                     camera.source.depth_offset_m));
      made.images.back().header.frame_id = frame_of(camera);
    }
    geometry_msgs::msg::TransformStamped transform = tf2::eigenToTransform(camera.source.X_PC);
    transform.header.stamp = now();
    transform.header.frame_id = camera.source.parent_link;
    transform.child_frame_id = frame_of(camera);
    transforms_.sendTransform(transform);
  }

  void plan() {
    for (std::size_t i = 0; i < scene_.joints->size(); ++i) {
      events_.push_back({scene_.joints->sample(i).stamp_s, -1, i});
    }
    for (std::size_t c = 0; c < scene_.cameras.size(); ++c) {
      for (std::size_t i = 0; i < scene_.cameras[c].at_exposure.size(); ++i) {
        events_.push_back({scene_.cameras[c].at_exposure[i].stamp_s, static_cast<int>(c), i});
      }
    }
    std::stable_sort(events_.begin(), events_.end(),
                     [](const Event& a, const Event& b) { return a.time_s < b.time_s; });
  }

  void play() {
    while (true) {
      if (next_ == events_.size()) {
        if (!does_loop_) return;
        start_ += rclcpp::Duration::from_seconds(events_.back().time_s + kBetweenRounds_s);
        next_ = 0;
      }
      const Event& event = events_[next_];
      const rclcpp::Time stamp = start_ + rclcpp::Duration::from_seconds(event.time_s);
      if (stamp > now()) return;
      publish(event, stamp);
      ++next_;
    }
  }

  void publish(const Event& event, const rclcpp::Time& stamp) {
    if (event.camera < 0) {
      joint_state_.header.stamp = stamp;
      joint_state_.position = scene_.joints->sample(event.index).position;
      return joints_->publish(joint_state_);
    }
    Camera& camera = cameras_[event.camera];
    camera.camera_info.header.stamp = stamp;
    camera.info->publish(camera.camera_info);
    auto image = std::make_unique<Image>(camera.images[event.index]);
    image->header.stamp = stamp;
    camera.image->publish(std::move(image));
  }

  berth::OpenScene scene_;
  bool does_loop_ = true;
  tf2_ros::StaticTransformBroadcaster transforms_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr description_;
  rclcpp::Publisher<JointState>::SharedPtr joints_;
  JointState joint_state_;
  std::vector<Camera> cameras_;
  std::vector<Event> events_;
  std::size_t next_ = 0;
  rclcpp::Time start_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace berth_ros

RCLCPP_COMPONENTS_REGISTER_NODE(berth_ros::ScenePlayerNode)
