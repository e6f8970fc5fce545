// A robot among obstacles, and what an ideal depth camera sees of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "berth/robot/kinematics.hpp"
#include "sim/drawn_camera.hpp"
#include "sim/mesh_distance.hpp"
#include "sim/random.hpp"

namespace berth::sim {

struct DrawnSceneSettings {
  int width_px = 640;
  int height_px = 480;
  /// Whether each further camera has an image of a size of its own.
  bool sizes_differ = true;
  /// Obstacles around the robot, besides floor and wall; fewer where there is no room for them.
  int least_obstacles = 1;
  int most_obstacles = 8;
  /// A floor below the robot, and a wall behind it as the camera sees it.
  bool has_room = true;
  /// No obstacle is nearer to the robot's meshes; 0 allows touching.
  double least_clearance_m = 0;
};

/// A thing in its own frame O.
struct DrawnObstacle {
  TriangleMesh mesh_O;
  Pose X_BO;
};

struct DrawnScene {
  Camera camera;
  Pose X_BC;
  JointState joints;
  RobotPose pose;
  std::vector<DrawnObstacle> obstacles;
  /// R and I.
  RobotImage robot;
  /// What the sensor sees: robot and obstacles at the pixels' centres, NaN where nothing is.
  DepthImage depth_m;
  /// What an ideal self filter leaves of it: NaN where the robot is what the sensor sees.
  DepthImage obstacle_depth_m;
};

/// Depends on its arguments alone. The robot stands at random joint positions within its limits
/// (continuous ones within +- pi), with obstacles near it that do not meet it (`link_trees` are
/// the model's), and a camera around it that sees some of it. Images by Embree's rays, in the
/// conventions of RobotImage: nothing of src/berth/render. Throws std::runtime_error where the
/// robot cannot be seen from anywhere.
DrawnScene draw_scene(const RobotModel& model, const std::vector<MeshTree>& link_trees,
                      const DrawnSceneSettings& settings, std::uint32_t seed);

/// A floor below the robot, and a wall behind it as a camera with this pose sees it.
void add_room(Random& random, const RobotExtent& robot, const Pose& X_BC,
              std::vector<DrawnObstacle>& obstacles);

/// Within the limits, continuous joints within +- pi.
JointState draw_joints(Random& random, const RobotModel& model);

/// What an ideal camera sees of them alone; NaN where nothing is.
DepthImage cast_obstacles(const std::vector<DrawnObstacle>& obstacles, const Camera& camera,
                          const Pose& X_BC);

/// The obstacles as links of a robot, [i] that of obstacles[i], for whoever renders them.
RobotModel obstacle_model(const std::vector<DrawnObstacle>& obstacles);
RobotPose obstacle_pose(const std::vector<DrawnObstacle>& obstacles);

}  // namespace berth::sim
