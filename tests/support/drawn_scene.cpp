#include "tests/support/drawn_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "berth/robot/primitives.hpp"
#include "tests/support/drawn_obstacles.hpp"
#include "tests/support/embree_renderer.hpp"

namespace berth::testing {
namespace {

/// A camera that sees less than this share of its pixels filled by the robot is drawn again.
constexpr double kLeastRobotShare = 0.01;
constexpr int kMostCameras = 50;
/// Of obstacles, most of which meet the robot where it is crowded.
constexpr int kMostTries = 500;
/// No obstacle comes nearer to the camera.
constexpr double kLeastCameraClearance_m = 0.25;
constexpr double kRoomHalf_m = 4;
constexpr double kWallThickness_m = 0.1;

/// A ball around the evaluated links, and the lowest point of all links.
struct Extent {
  Eigen::Vector3d centre_B_m;
  double radius_m;
  double lowest_z_m;
};

Extent extent_of(const RobotModel& model, const RobotPose& pose) {
  Eigen::AlignedBox3d evaluated_B;
  double lowest_z_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    for (const auto& vertex : model.links[i].mesh_L.vertices_m) {
      const Eigen::Vector3d p_B = pose.X_BL[i] * vertex.cast<double>();
      if (model.links[i].role == LinkRole::evaluated) evaluated_B.extend(p_B);
      lowest_z_m = std::min(lowest_z_m, p_B.z());
    }
  }
  return {evaluated_B.center(), evaluated_B.diagonal().norm() / 2, lowest_z_m};
}

Camera draw_camera(Random& random, const DrawnSceneSettings& settings) {
  Camera camera{settings.width_px, settings.height_px};
  camera.fx_px = settings.width_px * random(0.6, 1.1);
  camera.fy_px = camera.fx_px * random(0.98, 1.02);
  camera.cx_px = settings.width_px * random(0.47, 0.53) - 0.5;
  camera.cy_px = settings.height_px * random(0.47, 0.53) - 0.5;
  return camera;
}

/// Around the robot, from a little below its middle up to steeply above.
Pose draw_camera_pose(Random& random, const Extent& robot) {
  const double around = random(-std::numbers::pi, std::numbers::pi);
  const double up = random(-0.2, 1.2);
  const Eigen::Vector3d away(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around),
                             std::sin(up));
  const Eigen::Vector3d target_B_m =
      robot.centre_B_m +
      0.4 * robot.radius_m * Eigen::Vector3d(random(-1, 1), random(-1, 1), random(-1, 1));
  const double distance_m = robot.radius_m * random(1.3, 3.5);
  const Eigen::Vector3d z = -away;
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Pose X_BC;
  X_BC.linear() << x, z.cross(x), z;
  X_BC.linear() *=
      Eigen::AngleAxisd(random(-0.3, 0.3), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X_BC.translation() = target_B_m + distance_m * away;
  return X_BC;
}

RobotImage cast_image(const EmbreeRenderer& rays, const Camera& camera) {
  RobotImage image;
  image.depth_m = DepthImage(camera.width_px, camera.height_px, kNoDepth);
  image.link_id = Image<LinkId>(camera.width_px, camera.height_px, kNoLink);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const RayHit hit = rays.hit(u, v);
      if (hit.id == kNoLink) continue;
      image.depth_m(u, v) = static_cast<float>(hit.depth_m);
      image.link_id(u, v) = hit.id;
    }
  }
  return image;
}

bool is_seen(const Image<LinkId>& link_id) {
  const auto seen = std::count_if(link_id.pixels().begin(), link_id.pixels().end(), [](LinkId id) {
    return id != kNoLink && id != kEnvironmentLink;
  });
  return static_cast<double>(seen) >
         kLeastRobotShare * static_cast<double>(link_id.pixels().size());
}

/// Sets camera, X_BC and the robot's image.
void look_at_robot(Random& random, const RobotModel& model, const Extent& robot,
                   const DrawnSceneSettings& settings, DrawnScene& scene) {
  for (int i = 0; i < kMostCameras; ++i) {
    scene.camera = draw_camera(random, settings);
    scene.X_BC = draw_camera_pose(random, robot);
    scene.robot =
        cast_image(EmbreeRenderer(model, scene.pose, scene.X_BC, scene.camera), scene.camera);
    if (is_seen(scene.robot.link_id)) return;
  }
  throw std::runtime_error(
      fmt::format("robot \"{}\": none of {} cameras sees it", model.name, kMostCameras));
}

DrawnObstacle box_at(const Eigen::Vector3d& size_m, const Pose& X_BO) {
  return {make_box(size_m), X_BO};
}

void add_room(Random& random, const Extent& robot, DrawnScene& scene) {
  const double floor_z_m = std::min(robot.lowest_z_m - robot.radius_m * random(0.02, 0.3),
                                    scene.X_BC.translation().z() - kLeastCameraClearance_m);
  Pose X_BO = Pose::Identity();
  X_BO.translation() = robot.centre_B_m;
  X_BO.translation().z() = floor_z_m - kWallThickness_m / 2;
  const double size_m = 2 * kRoomHalf_m;
  scene.obstacles.push_back(box_at({size_m, size_m, kWallThickness_m}, X_BO));
  Eigen::Vector3d away = scene.X_BC.linear().col(2);
  away.z() = 0;
  X_BO.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), away).toRotationMatrix();
  X_BO.translation() = robot.centre_B_m + robot.radius_m * random(1.1, 2.5) * away.normalized();
  scene.obstacles.push_back(box_at({kWallThickness_m, size_m, size_m}, X_BO));
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
                   const Extent& robot, const DrawnSceneSettings& settings, DrawnScene& scene) {
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

void cast_obstacles(DrawnScene& scene) {
  const RobotModel model = obstacle_model(scene.obstacles);
  const EmbreeRenderer rays(model, obstacle_pose(scene.obstacles), scene.X_BC, scene.camera);
  scene.obstacle_depth_m = cast_image(rays, scene.camera).depth_m;
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

DrawnScene draw_scene(const RobotModel& model, const std::vector<MeshTree>& link_trees,
                      const DrawnSceneSettings& settings, std::uint32_t seed) {
  Random random(seed);
  DrawnScene scene;
  scene.joints = draw_joints(random, model);
  forward_kinematics(model, scene.joints.position, scene.pose);
  const Extent robot = extent_of(model, scene.pose);
  look_at_robot(random, model, robot, settings, scene);
  if (settings.has_room) add_room(random, robot, scene);
  add_obstacles(random, model, link_trees, robot, settings, scene);
  cast_obstacles(scene);
  return scene;
}

}  // namespace berth::testing
