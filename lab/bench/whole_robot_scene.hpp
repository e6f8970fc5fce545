// Drawn scenes that three cameras see, for the distances of the whole robot.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/render/robot_renderer.hpp"
#include "berth/types/joint_state.hpp"
#include "berth/types/obstacle_image.hpp"
#include "sim/drawn_scene.hpp"

namespace berth::lab {

inline constexpr int kSceneCameras = 3;

/// What one camera brought.
struct CameraImages {
  Pose X_BC;
  DepthImage depth_m;
  RobotImage robot;
  ObstacleImage obstacles;
};

struct WholeRobotScene {
  /// Of all views.
  Camera camera;
  RobotPose pose;
  JointState joints;
  /// kSceneCameras of them.
  std::vector<CameraImages> views;
  /// Joint angles that are asked about next, up to 0.05 rad from the first.
  std::vector<JointState> next_joints;
  std::vector<RobotPose> next_poses;
};

class WholeRobotScenes {
 public:
  WholeRobotScenes(RobotModel model, int width_px, int height_px);

  /// Depends on the seed and the arguments of the constructor alone.
  WholeRobotScene draw(std::uint32_t seed) const;

 private:
  CameraImages see(const sim::DrawnScene& drawn, const Pose& X_BC) const;

  RobotModel model_;
  std::vector<sim::MeshTree> link_trees_;
  sim::DrawnSceneSettings settings_;
};

}  // namespace berth::lab
