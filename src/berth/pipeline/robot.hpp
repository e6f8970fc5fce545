#pragma once

#include <memory>

#include "berth/distance/evaluate.hpp"
#include "berth/distance/mesh/robot_patches.hpp"
#include "berth/pipeline/timeliness.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/visibility/sample_points.hpp"

namespace berth {

/// How questions about a robot are answered, whichever cameras see it.
struct EvaluationSettings {
  Method method = Method::mesh;
  DistanceSettings distance;
  /// Whether answers tell what the cameras cannot know (Answer::visibility).
  bool visibility = true;
  TimeSettings time;
};

/// A robot and what is asked about it: constant once made, shared by all views, observers and
/// askers, and their threads.
class Robot {
 public:
  /// Throws std::invalid_argument that names the setting, its value and what was expected.
  explicit Robot(RobotModel model, EvaluationSettings settings = {});

  const RobotModel& model() const { return model_; }
  const EvaluationSettings& settings() const { return settings_; }
  const std::shared_ptr<const LinkMeshes>& meshes() const { return meshes_; }
  /// Of method `mesh`; null with the others.
  const std::shared_ptr<const RobotPatches>& patches() const { return patches_; }
  /// Where find_visibility() looks; none unless settings or method ask for it.
  const SamplePoints& sample_points() const { return sample_points_; }

 private:
  RobotModel model_;
  EvaluationSettings settings_;
  std::shared_ptr<const LinkMeshes> meshes_;
  std::shared_ptr<const RobotPatches> patches_;
  SamplePoints sample_points_;
};

}  // namespace berth
