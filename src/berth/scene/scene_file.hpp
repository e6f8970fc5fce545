// A scene file as it stands on disk: checked, its paths resolved.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "berth/pipeline/view.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/types/camera.hpp"

namespace berth {

/// A camera as SCENE.yaml tells of it, with the files of its images.
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
  /// Those of the scene, with the camera's own over them.
  ViewSettings settings;
};

/// All that SCENE.yaml says.
struct SceneFile {
  std::filesystem::path file;
  RobotSettings robot;
  std::vector<SceneCamera> cameras;
  std::filesystem::path joints;
  /// Defaults where the file says nothing; the limits between joint samples and images are then
  /// kOnlyBetweenSamples.
  EvaluationSettings evaluation;
};

/// Reads SCENE.yaml; paths in it are relative to the file. Opens none of the files that it names,
/// but expands globs. Throws std::runtime_error with file, line, key, value and what was expected:
/// unknown or missing keys, keys that stand twice, wrong types, values outside their domain, a glob
/// without match.
SceneFile read_scene(const std::filesystem::path& file);

}  // namespace berth
