#pragma once

#include <map>
#include <memory>
#include <string>

#include "berth/distance/evaluate.hpp"
#include "berth/pipeline/timeliness.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/sensor/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/visibility/sample_points.hpp"

namespace berth {

/// A camera and what it is fixed to: any link of the robot, the root or the hand.
struct CameraMount {
  Camera camera;
  std::string parent_link;
  /// The pose of the optical frame C in the parent link's frame P; to be set, NaN is refused.
  Pose X_PC = unset_pose();
};

/// How a camera's images become distances.
struct RigSettings {
  SelfFilterSettings self_filter;
  /// Padding of single links by name, instead of self_filter.padding_m.
  std::map<std::string, double> link_padding_m;
  SensorSettings sensor;
  Method method = Method::exact;
  DistanceSettings distance;
  /// Whether answers tell what the camera cannot know (Answer::visibility).
  bool visibility = true;
  TimeSettings time;
};

/// One robot and one camera that sees it: constant once made, shared by the two clocks and their
/// threads.
class Rig {
 public:
  /// Throws std::invalid_argument that names the setting, its value and what was expected: an
  /// unknown link, a pose that is not one, a camera without size, a value outside its domain, a
  /// background for a camera that moves with the robot.
  Rig(RobotModel model, CameraMount mount, RigSettings settings);

  const RobotModel& model() const { return model_; }
  const CameraMount& mount() const { return mount_; }
  const Camera& camera() const { return mount_.camera; }
  const RigSettings& settings() const { return settings_; }
  const std::shared_ptr<const LinkMeshes>& meshes() const { return meshes_; }
  /// Where find_visibility() looks.
  const SamplePoints& sample_points() const { return sample_points_; }
  /// Those of robot_region(); null where SelfFilterSettings::robot_region_scale is 0.
  const std::shared_ptr<const LinkMeshes>& region_meshes() const { return region_meshes_; }
  /// The camera's pose X_BC in the robot's root link, with the robot in this pose.
  Pose camera_pose(const RobotPose& pose) const { return pose.X_BL[parent_] * mount_.X_PC; }

 private:
  RobotModel model_;
  CameraMount mount_;
  RigSettings settings_;
  std::size_t parent_ = 0;
  std::shared_ptr<const LinkMeshes> meshes_;
  SamplePoints sample_points_;
  std::shared_ptr<const LinkMeshes> region_meshes_;
};

}  // namespace berth
