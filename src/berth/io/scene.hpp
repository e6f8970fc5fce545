// A scene file as it stands on disk: checked, its paths resolved, its defaults left to whom they
// belong.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "berth/types/camera.hpp"

namespace berth {

struct SceneRobot {
  enum class Geometry { visual, collision };
  std::filesystem::path urdf;
  /// What package://NAME/ means.
  std::map<std::string, std::filesystem::path> package_paths;
  Geometry geometry = Geometry::visual;
  std::vector<std::string> environment_links;
  std::vector<std::string> ignore_links;
};

struct SceneCamera {
  std::string name;
  std::filesystem::path info;
  std::string parent_link;
  /// The pose of the optical frame C in the parent link's frame P; NaN until it is read.
  Pose X_PC = unset_pose();
  std::vector<std::filesystem::path> depth;
  double depth_scale_m = 0.001;
  /// One for each image, increasing. Empty: image k belongs to row k of the joints.
  std::vector<double> stamps_s;
  double near_m = 0;
  double far_m = std::numeric_limits<double>::infinity();
};

/// The self filter's settings that the file gives.
struct SceneSelfFilter {
  /// The tolerance at depth z is tolerance_m + tolerance_per_m z + tolerance_per_m2 z^2.
  std::optional<double> tolerance_m;
  std::optional<double> tolerance_per_m;
  std::optional<double> tolerance_per_m2;
  std::optional<double> padding_m;
  std::map<std::string, double> link_padding_m;
  std::optional<int> dilation_px;
  std::optional<double> edge_jump_m;
  std::optional<double> island_radius_m;
  std::optional<double> island_jump_m;
  std::optional<double> robot_region_scale;
};

/// The sensor rules' settings that the file gives.
struct SceneSensor {
  std::optional<double> noise_m;
  std::optional<int> speckle_px;
  std::optional<double> speckle_jump_m;
  std::optional<int> average_frames;
  std::optional<int> background_frames;
  std::optional<double> background_clearance_m;
  std::optional<std::string> holes;
};

/// The evaluation's settings that the file gives.
struct SceneEvaluation {
  std::optional<std::string> method;
  std::optional<double> range_m;
  std::optional<bool> mean_direction;
  std::optional<bool> visibility;
};

/// How near the joint samples have to be to an image, as far as the file says.
struct SceneTime {
  std::optional<double> max_skew_s;
  std::optional<double> max_extrapolation_s;
};

struct SceneFile {
  std::filesystem::path file;
  SceneRobot robot;
  std::vector<SceneCamera> cameras;
  std::filesystem::path joints;
  SceneSelfFilter self_filter;
  SceneSensor sensor;
  SceneEvaluation evaluation;
  SceneTime time;
};

/// Reads SCENE.yaml; paths in it are relative to the file. Opens none of the files that it names,
/// but expands globs. Throws std::runtime_error with file, line, key, value and what was expected:
/// unknown or missing keys, keys that stand twice, wrong types, values outside their domain, a glob
/// without match.
SceneFile read_scene(const std::filesystem::path& file);

}  // namespace berth
