#include "scene_messages.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sensor_msgs/image_encodings.hpp>
#include <sstream>
#include <tf2_eigen/tf2_eigen.hpp>

#include "berth/files/depth_units.hpp"

namespace berth_ros {
namespace {

using sensor_msgs::msg::CameraInfo;
using sensor_msgs::msg::Image;

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

CameraInfo info_of(const berth::Camera& camera, const berth::Lens& lens) {
  CameraInfo info;
  info.width = static_cast<std::uint32_t>(camera.width_px);
  info.height = static_cast<std::uint32_t>(camera.height_px);
  info.distortion_model = lens.is_fisheye ? "equidistant" : "rational_polynomial";
  info.d.assign(lens.coefficients.begin(), lens.coefficients.end());
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

PlayedScene::PlayedScene(const std::string& file)
    : file_(berth::read_scene(file)), scene_(berth::open_scene(file_)) {}

std::size_t PlayedScene::frame_at(std::size_t camera, double time_s) const {
  const auto& exposures = scene_.cameras[camera].at_exposure;
  const auto nearest =
      std::min_element(exposures.begin(), exposures.end(),
                       [&](const berth::JointState& a, const berth::JointState& b) {
                         return std::abs(a.stamp_s - time_s) < std::abs(b.stamp_s - time_s);
                       });
  return static_cast<std::size_t>(nearest - exposures.begin());
}

void PlayedScene::joints_at(double time_s, berth::JointState& out) const {
  joints().at(time_s, berth::kOnlyBetweenSamples, out);
}

SceneMessages::SceneMessages(rclcpp::Node& node, const PlayedScene& scene) : transforms_(node) {
  // Within a process, who comes late would get nothing.
  rclcpp::PublisherOptions options;
  options.use_intra_process_comm = rclcpp::IntraProcessSetting::Disable;
  description_ = node.create_publisher<std_msgs::msg::String>(
      "robot_description", rclcpp::QoS(1).transient_local().reliable(), options);
  std_msgs::msg::String description;
  description.data = urdf_with_file_names(scene.file());
  description_->publish(description);
  joints_ = node.create_publisher<sensor_msgs::msg::JointState>("joint_states", rclcpp::QoS(50));
  for (const berth::MovableJoint& joint : scene.scene().robot->model().joints) {
    joint_state_.name.push_back(joint.name);
  }
  for (const berth::OpenCamera& camera : scene.scene().cameras) add_camera(node, camera);
  transforms_.sendTransform(mounts_);
}

void SceneMessages::add_camera(rclcpp::Node& node, const berth::OpenCamera& camera) {
  const berth::SceneCamera& source = camera.source;
  const rclcpp::QoS qos = rclcpp::QoS(5);
  Camera& made = cameras_.emplace_back();
  made.image = node.create_publisher<Image>(source.name + "/depth_image", qos);
  made.info = node.create_publisher<CameraInfo>(source.name + "/camera_info", qos);
  // As the camera gave them: the node rectifies them by the same scene.
  const auto& rectification = camera.rectification;
  made.camera_info =
      info_of(camera.given(),
              rectification && rectification->lens() ? *rectification->lens() : berth::Lens());
  made.camera_info.header.frame_id = frame_of(camera);
  for (std::size_t i = 0; i < source.depth.size(); ++i) {
    made.images.push_back(
        image_of(camera.read_given(i), source.depth_scale_m, source.depth_offset_m));
    made.images.back().header.frame_id = frame_of(camera);
  }
  geometry_msgs::msg::TransformStamped& mount =
      mounts_.emplace_back(tf2::eigenToTransform(source.X_PC));
  mount.header.stamp = node.now();
  mount.header.frame_id = source.parent_link;
  mount.child_frame_id = frame_of(camera);
}

void SceneMessages::publish_image(std::size_t camera, std::size_t frame,
                                  const rclcpp::Time& stamp) {
  Camera& from = cameras_[camera];
  from.camera_info.header.stamp = stamp;
  from.info->publish(from.camera_info);
  auto image = std::make_unique<Image>(from.images[frame]);
  image->header.stamp = stamp;
  from.image->publish(std::move(image));
}

void SceneMessages::publish_joints(const berth::JointState& joints, const rclcpp::Time& stamp) {
  joint_state_.header.stamp = stamp;
  joint_state_.position = joints.position;
  joints_->publish(joint_state_);
}

}  // namespace berth_ros
