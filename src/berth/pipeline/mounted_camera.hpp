#pragma once

#include <map>
#include <memory>
#include <string>

#include "berth/pipeline/robot.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/sensor/settings.hpp"
#include "berth/space/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/watch/watch_settings.hpp"

namespace berth {

/// A camera and what it is fixed to: any link of the robot, the root or the hand.
struct CameraMount {
  Camera camera;
  std::string parent_link;
  /// The pose of the optical frame C in the parent link's frame P; to be set, NaN is refused.
  Pose X_PC = unset_pose();
  /// By which results call it.
  std::string name = "camera";
};

/// Settings of one camera's images.
struct CameraSettings {
  SelfFilterSettings self_filter;
  /// Padding of single links by name, instead of self_filter.padding_m.
  std::map<std::string, double> link_padding_m;
  SensorSettings sensor;
  SpaceSettings space;
  /// Whether the camera stands where it should. It only reports, since images that a program makes
  /// up need not show the robot; settings_of_real_camera() refuses.
  WatchSettings watch = {.tell_only = true};
};

/// What scenes and ROS nodes begin with: an image whose robot is elsewhere is not used.
CameraSettings settings_of_real_camera();

/// The lists of a camera's settings, each with its name in scene files.
template <SettingsOf<CameraSettings> Settings, class Visitor>
void visit_setting_groups(Settings& s, Visitor&& visit) {
  visit("self_filter", s.self_filter);
  visit("sensor", s.sensor);
  visit("space", s.space);
  visit("watch", s.watch);
}

/// One camera that sees the robot: constant once made, shared by its observers, frames and their
/// threads.
class MountedCamera {
 public:
  /// Throws std::invalid_argument that names the setting, its value and what was expected: an
  /// unknown link, a pose that is not one, a camera without size, a value outside its domain, a
  /// background for a camera that moves with the robot.
  MountedCamera(std::shared_ptr<const Robot> robot, CameraMount mount,
                CameraSettings settings = {});

  const std::shared_ptr<const Robot>& robot() const { return robot_; }
  const CameraMount& mount() const { return mount_; }
  const Camera& camera() const { return mount_.camera; }
  const CameraSettings& settings() const { return settings_; }
  /// Those of robot_region(); null where SelfFilterSettings::robot_region_scale is 0.
  const std::shared_ptr<const LinkMeshes>& region_meshes() const { return region_meshes_; }
  /// The camera's pose X_BC in the robot's root link, with the robot in this pose.
  Pose camera_pose(const RobotPose& pose) const;
  /// The same for a camera that has moved on its parent link.
  Pose camera_pose(const RobotPose& pose, const Pose& X_PC) const;

 private:
  std::shared_ptr<const Robot> robot_;
  CameraMount mount_;
  CameraSettings settings_;
  std::size_t parent_ = 0;
  std::shared_ptr<const LinkMeshes> region_meshes_;
};

/// The same camera on a robot that has taken something up or put it down.
std::shared_ptr<const MountedCamera> with_robot(const MountedCamera& mounted,
                                                std::shared_ptr<const Robot> robot);

}  // namespace berth
