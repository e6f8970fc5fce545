#include "sim/drawn_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "berth/robot/primitives.hpp"
#include "sim/drawn_camera.hpp"
#include "sim/drawn_obstacles.hpp"
#include "sim/embree_renderer.hpp"
#include "sim/turn_between.hpp"

namespace berth::sim {
namespace {

constexpr int kMostCameras = 50;
/// Of obstacles, most of which meet the robot where it is crowded.
constexpr int kMostTries = 500;
constexpr double kRoomHalf_m = 4;
constexpr double kWallThickness_m = 0.1;

/// Sets camera, X_BC and the robot's image.
void look_at_robot(Random& random, const RobotModel& model, const RobotExtent& robot,
                   const DrawnSceneSettings& settings, DrawnScene& scene) {
  for (int i = 0; i < kMostCameras; ++i) {
    scene.camera = draw_camera(random, settings.width_px, settings.height_px);
    scene.X_BC = draw_camera_pose(random, robot);
    scene.robot =
        cast_image(EmbreeRenderer(model, scene.pose, scene.X_BC, scene.camera), scene.camera);
    if (robot_share(scene.robot) > kLeastRobotShare) return;
  }
  throw std::runtime_error(
      fmt::format("robot \"{}\": none of {} cameras sees it", model.name, kMostCameras));
}

DrawnObstacle box_at(const Eigen::Vector3d& size_m, const Pose& X_BO) {
  return {make_box(size_m), X_BO};
}

/// A point on a link, each link as likely as the others.
Eigen::Vector3d draw_robot_point_B(Random& random, const RobotModel& model, const RobotPose& pose) {
  const std::size_t index = model.evaluated_links[random.whole(0, model.link_count() - 1)];
  const TriangleMesh& mesh_L = model.links[index].mesh_L;
  const int vertex = random.whole(0, static_cast<int>(mesh_L.vertices_m.size()) - 1);
  return pose.X_BL[index] * mesh_L.vertices_m[vertex].cast<double>();
}

bool is_clear_of_robot(const DrawnObstacle& obstacle, const std::vector<MeshTree>& link_trees,
                       const RobotPose& pose, double clearance_m) {
  const MeshTree tree = build_mesh_tree(obstacle.mesh_O);
  for (std::size_t i = 0; i < link_trees.size(); ++i) {
    // Surfaces that meet are at distance 0, which no clearance allows.
    const double less_than_m = std::max(clearance_m, 1e-6);
    if (closest_points(link_trees[i], pose.X_BL[i], tree, obstacle.X_BO, less_than_m).distance_m <
        less_than_m) {
      return false;
    }
  }
  return true;
}

/// Most stand near the robot: their distance from one of its points is of the order of their size.
void add_obstacles(Random& random, const RobotModel& model, const std::vector<MeshTree>& link_trees,
                   const RobotExtent& robot, const DrawnSceneSettings& settings,
                   DrawnScene& scene) {
  const int count = random.whole(settings.least_obstacles, settings.most_obstacles);
  const std::size_t wanted = scene.obstacles.size() + count;
  for (int tries = 0; scene.obstacles.size() < wanted && tries < kMostTries; ++tries) {
    const double radius_m = robot.radius_m * random(0.05, 0.4);
    DrawnObstacle obstacle{draw_obstacle(random, radius_m), Pose(draw_rotation(random))};
    const Eigen::Vector3d direction = draw_rotation(random) * Eigen::Vector3d::UnitX();
    const double share = random(0, 1);
    const double distance_m = radius_m + robot.radius_m * share * share;
    obstacle.X_BO.translation() =
        draw_robot_point_B(random, model, scene.pose) + distance_m * direction;
    const double to_camera_m =
        (obstacle.X_BO.translation() - scene.X_BC.translation()).norm() - radius_m;
    if (to_camera_m < kLeastCameraClearance_m) continue;
    if (!is_clear_of_robot(obstacle, link_trees, scene.pose, settings.least_clearance_m)) continue;
    scene.obstacles.push_back(std::move(obstacle));
  }
}

void sense(DrawnScene& scene) {
  scene.obstacle_depth_m = cast_obstacles(scene.obstacles, scene.camera, scene.X_BC);
  scene.depth_m = scene.obstacle_depth_m;
  for (std::size_t i = 0; i < scene.depth_m.pixels().size(); ++i) {
    const float robot_m = scene.robot.depth_m.pixels()[i];
    if (std::isnan(robot_m) || scene.depth_m.pixels()[i] < robot_m) continue;
    scene.depth_m.pixels()[i] = robot_m;
    scene.obstacle_depth_m.pixels()[i] = kNoDepth;
  }
}

}  // namespace

JointState draw_joints(Random& random, const RobotModel& model) {
  JointState joints;
  for (const MovableJoint& joint : model.joints) {
    joints.position.push_back(
        random(std::max(joint.lower, -std::numbers::pi), std::min(joint.upper, std::numbers::pi)));
  }
  return joints;
}

DepthImage cast_obstacles(const std::vector<DrawnObstacle>& obstacles, const Camera& camera,
                          const Pose& X_BC) {
  std::vector<PosedMesh> meshes;
  for (const DrawnObstacle& obstacle : obstacles)
    meshes.push_back({&obstacle.mesh_O, obstacle.X_BO});
  return RayCaster(meshes, X_BC, camera).cast_depth();
}

RobotModel obstacle_model(const std::vector<DrawnObstacle>& obstacles) {
  RobotModel model;
  model.name = "obstacles";
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    Link link;
    link.name = fmt::format("obstacle_{}", i);
    link.role = LinkRole::evaluated;
    link.id = static_cast<LinkId>(i + 1);
    link.mesh_L = obstacles[i].mesh_O;
    model.links.push_back(std::move(link));
    model.evaluated_links.push_back(i);
  }
  return model;
}

RobotPose obstacle_pose(const std::vector<DrawnObstacle>& obstacles) {
  RobotPose pose;
  for (const DrawnObstacle& obstacle : obstacles) pose.X_BL.push_back(obstacle.X_BO);
  return pose;
}

void add_room(Random& random, const RobotExtent& robot, const Pose& X_BC,
              std::vector<DrawnObstacle>& obstacles) {
  const double floor_z_m = std::min(robot.lowest_z_m - robot.radius_m * random(0.02, 0.3),
                                    X_BC.translation().z() - kLeastCameraClearance_m);
  Pose X_BO = Pose::Identity();
  X_BO.translation() = robot.centre_B_m;
  X_BO.translation().z() = floor_z_m - kWallThickness_m / 2;
  const double size_m = 2 * kRoomHalf_m;
  obstacles.push_back(box_at({size_m, size_m, kWallThickness_m}, X_BO));
  Eigen::Vector3d away = X_BC.linear().col(2);
  away.z() = 0;
  X_BO.linear() = turn_between(Eigen::Vector3d::UnitX(), away).toRotationMatrix();
  X_BO.translation() = robot.centre_B_m + robot.radius_m * random(1.1, 2.5) * away.normalized();
  obstacles.push_back(box_at({kWallThickness_m, size_m, size_m}, X_BO));
}

DrawnScene draw_scene(const RobotModel& model, const std::vector<MeshTree>& link_trees,
                      const DrawnSceneSettings& settings, std::uint32_t seed) {
  Random random(seed);
  DrawnScene scene;
  scene.joints = draw_joints(random, model);
  forward_kinematics(model, scene.joints.position, scene.pose);
  const RobotExtent robot = extent_of(model, scene.pose);
  look_at_robot(random, model, robot, settings, scene);
  if (settings.has_room) add_room(random, robot, scene.X_BC, scene.obstacles);
  add_obstacles(random, model, link_trees, robot, settings, scene);
  sense(scene);
  return scene;
}

}  // namespace berth::sim
