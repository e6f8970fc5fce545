// The whole scene: meshes, motion and camera.
#pragma once

#include <vector>

#include "berth/types/camera.hpp"
#include "lab/bundled_scene/arm_meshes.hpp"
#include "lab/bundled_scene/motion.hpp"
#include "lab/bundled_scene/ray_caster.hpp"

namespace berth::lab {

struct Scene {
  std::array<DrawnMesh, kArmLinks> arm;
  std::vector<DrawnMesh> table;
  std::vector<DrawnMesh> boxes;
  std::vector<DrawnMesh> person;
  std::vector<JointRow> rows;
};
Scene make_scene();

/// Points into the scene; all poses in the table's frame.
struct PosedScene {
  std::vector<PosedMesh> robot;  ///< the arm's links first, then the table
  std::vector<PosedMesh> obstacles;
};
PosedScene pose_scene(const Scene& scene, double time_s);

/// 640 x 480 with a Kinect's angle of view.
Camera scene_camera();

/// Of the camera's optical frame C in the table's frame T; rounded as the file's text is.
struct CameraPlace {
  Eigen::Vector3d xyz_T_m;
  Eigen::Quaterniond rotation_TC;
  Pose X_TC() const;
};
CameraPlace scene_camera_place();

}  // namespace berth::lab
