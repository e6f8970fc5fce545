// A scene file as it stands on disk: checked, its paths resolved.
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/sensor/rectification.hpp"
#include "berth/separation/settings.hpp"
#include "berth/types/camera.hpp"

namespace berth {

/// A camera as SCENE.yaml describes it, with the files of its images.
struct SceneCamera {
  std::string name;
  std::filesystem::path info;
  std::string parent_link;
  /// The pose of the optical frame C in the parent link's frame P; NaN until it is read.
  Pose X_PC = unset_pose();
  /// As the file has them; none where it has a quaternion.
  std::optional<Eigen::Vector3d> rpy_rad;
  std::vector<std::filesystem::path> depth;
  double depth_scale_m = 0.001;
  /// Added to each reading, once it is in metres.
  double depth_offset_m = 0;
  DepthIs depth_is = DepthIs::along_axis;
  /// Whether the images are; unset, a camera_info with distortion is refused.
  std::optional<bool> is_rectified;
  /// One for each image, increasing. Empty: image k belongs to row k of the joints.
  std::vector<double> stamps_s;
  /// The joints' clock at an exposure is its stamp plus this.
  double clock_offset_s = 0;
  double near_m = 0;
  double far_m = std::numeric_limits<double>::infinity();
  /// The background to begin with, in place of one that is learned from `depth`.
  std::optional<std::filesystem::path> background;
  /// Those of the scene, with the camera's own over them.
  CameraSettings settings = settings_of_real_camera();
};

/// The unit of a background's PNG, whatever that of the camera's images is.
inline constexpr double kBackgroundScale_m = 0.001;

/// Something that moves with a link, as the file describes it: one of the four shapes.
struct SceneAttachment {
  std::string link;
  /// Empty: a part of the link.
  std::string name;
  std::filesystem::path mesh;
  std::optional<Eigen::Vector3d> box_m;
  /// Radius and length.
  std::optional<Eigen::Vector2d> cylinder_m;
  std::optional<double> sphere_radius_m;
  Pose X_LA = Pose::Identity();
  bool is_sharp = false;
  bool is_soft = false;
  std::vector<std::string> may_touch = {};
  /// Such as "scene.yaml:12", for messages about what the file names.
  std::string place;
};

/// A scene as its file describes it.
struct SceneFile {
  std::filesystem::path file;
  /// What the file says in words that will not be read for long; for people.
  std::vector<std::string> warnings;
  RobotSettings robot;
  std::vector<SceneCamera> cameras;
  std::vector<SceneAttachment> attached;
  std::filesystem::path joints;
  /// Added to the positions in `joints`, rad or m, by the name of the joint.
  std::map<std::string, double> joint_offsets;
  /// The positions of joints that never move and have no column in `joints`, rad or m, by name.
  std::map<std::string, double> fixed_joints;
  /// Defaults where the file says nothing; the limits between joint samples and images are then
  /// kInRecordings.
  EvaluationSettings evaluation;
  /// None: nothing is monitored.
  std::optional<SeparationSettings> separation;
};

/// Reads SCENE.yaml; paths in it are relative to the file. Opens none of the files that it names,
/// but expands globs. Throws std::runtime_error with file, line, key, value and what was expected:
/// unknown or missing keys, keys that stand twice, wrong types, values outside their domain, a glob
/// without match.
SceneFile read_scene(const std::filesystem::path& file);

/// The same for a text that is, or will be, the content of `file`.
SceneFile parse_scene(const std::filesystem::path& file, const std::string& text);

}  // namespace berth
