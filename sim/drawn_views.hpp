// A drawn scene seen by several cameras.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/types/obstacle_image.hpp"
#include "sim/drawn_scene.hpp"
#include "sim/whole_robot_points.hpp"

namespace berth::sim {

/// What an ideal camera sees, and what an ideal self filter makes of it.
struct DrawnView {
  Camera camera;
  Pose X_BC = Pose::Identity();
  /// R and I.
  RobotImage robot;
  /// S: robot and obstacles at the pixels' centres, NaN where nothing is.
  DepthImage depth_m;
  /// F: what is left where the robot is not what the sensor sees.
  ObstacleImage obstacles;
  double age_s = 0;
};

/// Images by Embree's rays; nothing of src/berth/render.
DrawnView cast_view(const RobotModel& model, const RobotPose& pose,
                    const std::vector<DrawnObstacle>& obstacles, const Camera& camera,
                    const Pose& X_BC);

struct DrawnViews {
  /// Robot and obstacles; its camera is that of the first view.
  DrawnScene scene;
  std::vector<DrawnView> views;
};

/// draw_scene() of the same arguments, with `cameras` cameras altogether: each of the others sees
/// some of the robot and is 0.25 m clear of the obstacles. Of two calls with the same seed the one
/// with more cameras has the others' as well. Throws std::runtime_error where the robot cannot be
/// seen.
DrawnViews draw_views(const RobotModel& model, const std::vector<MeshTree>& link_trees,
                      const DrawnSceneSettings& settings, std::uint32_t seed, int cameras);

PointView point_view(const DrawnView& view);
PointSpace point_space(const std::vector<DrawnView>& views, const SpaceSettings& settings);

}  // namespace berth::sim
