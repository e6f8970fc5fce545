// What a node is told: by parameters, over a scene file where there is one.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <vector>

#include "berth/control/velocity_filter.hpp"
#include "berth/files/depth_units.hpp"
#include "berth/live/joint_intake.hpp"
#include "berth/live/live_camera.hpp"
#include "berth/pipeline/mounted_camera.hpp"
#include "berth/scene/scene_file.hpp"
#include "berth/separation/settings.hpp"
#include "setting_parameters.hpp"

namespace berth_ros {

/// Where a camera's pose comes from.
enum class PoseSource {
  automatic,  ///< TF from when on it knows the camera, before that the scene file
  tf,
  scene
};

/// One camera as the node is told of it.
struct CameraSettings {
  std::string name;
  /// Before its topics' names: "" or "left/".
  std::string topic_prefix;
  std::string image_transport = "raw";
  /// Whether the images are rectified, so that camera_info's P counts, or as its lens made them;
  /// none: nobody said it.
  std::optional<bool> is_rectified;
  berth::DepthIs depth_is = berth::DepthIs::along_axis;
  bool is_reliable = false;
  /// Their robot is taken out already.
  bool is_filtered = false;
  berth::DepthUnits units;
  berth::LiveCameraSettings live;
  berth::CameraSettings settings;
  PoseSource pose_source = PoseSource::automatic;
  /// Of the scene file.
  std::optional<berth::CameraMount> scene_mount;
};

/// Declares the parameters and keeps those that were given. Any thread may read them while one
/// takes changes.
class NodeSettings {
 public:
  /// Reads the scene file where `scene` names one. `camera_names` is the default of `cameras`;
  /// with one unnamed camera (self_filter_node) topics have no prefix. Throws std::runtime_error
  /// and std::invalid_argument for bad files and values.
  NodeSettings(SettingNode& node, bool has_one_camera);

  const std::optional<berth::SceneFile>& scene() const { return scene_; }
  /// Empty: the URDF comes as a message.
  const std::string& urdf_path() const { return urdf_path_; }
  /// Empty: the robot's base stands still.
  const std::string& world_frame() const { return world_frame_; }
  /// What the robot's model is loaded by, but for the URDF's text.
  berth::RobotSettings robot_settings() const { return robot_; }
  berth::JointIntakeSettings joint_settings() const { return joints_; }
  berth::EvaluationSettings evaluation() const { return evaluation_of(given()); }
  std::vector<CameraSettings> cameras() const { return cameras_of(given()); }
  /// None: nothing is monitored.
  std::optional<berth::SeparationSettings> separation() const { return separation_of(given()); }
  /// None: no velocities are filtered.
  std::optional<berth::VelocityFilterSettings> filter() const { return filter_of(given()); }
  /// Of the filtered velocities; empty: there are none.
  const std::string& command_topic() const { return command_topic_; }
  /// Empty: all of the model's, in its order.
  const std::vector<std::string>& filtered_joints() const { return filtered_joints_; }

  /// Throws std::invalid_argument for a parameter that somebody gave and nobody declared, with the
  /// nearest name; to be called once all are declared. Those of the other node pass, since a file
  /// may be for both.
  static void require_declared(SettingNode& node, bool has_one_camera);

  /// Throws std::invalid_argument where settings with these changes would be refused.
  void check(const std::vector<rclcpp::Parameter>& changes) const;
  /// Whether any of them is a setting of robot or cameras, so that those have to be made anew.
  bool take(const std::vector<rclcpp::Parameter>& changes);
  /// What was given so far, to be put back in place of what was taken since.
  GivenParameters given() const;
  void put_back(GivenParameters given);

 private:
  /// Tells what it warns of.
  void judge_scene(const SettingNode& node) const;
  void warn_unwatched(const SettingNode& node) const;
  void declare_robot(SettingNode& node);
  void declare_joints(SettingNode& node);
  void declare_evaluation(SettingNode& node);
  void declare_separation(SettingNode& node);
  void declare_filter(SettingNode& node);
  void declare_cameras(SettingNode& node, bool has_one_camera);
  void declare_camera(SettingNode& node, const std::string& name, bool has_one_camera);
  bool is_setting(const std::string& name) const;
  GivenParameters with(const std::vector<rclcpp::Parameter>& changes) const;
  /// The scene file's, else the defaults.
  berth::EvaluationSettings scene_evaluation() const;
  berth::EvaluationSettings evaluation_of(const GivenParameters& given) const;
  std::optional<berth::SeparationSettings> separation_of(const GivenParameters& given) const;
  std::optional<berth::VelocityFilterSettings> filter_of(const GivenParameters& given) const;
  std::vector<CameraSettings> cameras_of(const GivenParameters& given) const;

  std::optional<berth::SceneFile> scene_;
  std::string urdf_path_;
  std::string world_frame_;
  std::string command_topic_;
  std::vector<std::string> filtered_joints_;
  berth::RobotSettings robot_;
  berth::JointIntakeSettings joints_;
  std::vector<CameraSettings> cameras_;
  mutable std::mutex given_mutex_;
  GivenParameters given_;
};

}  // namespace berth_ros
