#include "sim/drawn_carried.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "berth/robot/primitives.hpp"
#include "sim/drawn_obstacles.hpp"
#include "sim/turn_between.hpp"

namespace berth::sim {
namespace {

constexpr int kMostTries = 100;
constexpr double kLeastSeenShare = 0.02;
constexpr double kClearance_m = 0.01;
constexpr int kThingsAround = 6;
constexpr int kThingsBeside = 4;

/// The rotation whose z axis is `z`.
Eigen::Matrix3d turned_to(const Eigen::Vector3d& z) {
  return turn_between(Eigen::Vector3d::UnitZ(), z).toRotationMatrix();
}

double extent_along(const TriangleMesh& mesh, const Eigen::Vector3d& from,
                    const Eigen::Vector3d& direction) {
  double most = 0;
  for (const Eigen::Vector3f& vertex : mesh.vertices_m) {
    most = std::max(most, (vertex.cast<double>() - from).dot(direction));
  }
  return most;
}

/// Evaluated links that a joint moves, in the order of the tree.
std::vector<std::size_t> moved_links(const RobotModel& model) {
  std::vector<std::size_t> links;
  for (const std::size_t link : model.evaluated_links) {
    if (model.is_moved(link)) links.push_back(link);
  }
  return links;
}

void add_box(const Eigen::Vector3d& root_L_m, const Eigen::Vector3d& direction_L,
             const Eigen::Vector3d& size_m, DrawnThing& thing) {
  DrawnThing::Piece piece{Pose::Identity(), size_m};
  piece.X_LP.linear() = turned_to(direction_L);
  piece.X_LP.translation() = root_L_m + size_m.z() / 2 * direction_L;
  thing.pieces.push_back(piece);
}

DrawnThing draw_thing(Random& random, const RobotModel& model, DrawnKind kind) {
  DrawnThing thing;
  if (kind == DrawnKind::bare) return thing;
  const std::vector<std::size_t> links = moved_links(model);
  thing.link = kind == DrawnKind::cable_box ? links[(links.size() - 1) / 2] : links.back();
  const TriangleMesh& mesh_L = model.links[thing.link].mesh_L;
  const Eigen::Vector3d middle = mesh_L.bounding_box_m().center().cast<double>();
  // Away from the joint, or to a side.
  Eigen::Vector3d direction =
      middle.norm() > 0.02 ? Eigen::Vector3d(middle.normalized()) : Eigen::Vector3d::UnitZ();
  if (kind == DrawnKind::cable_box) {
    direction = direction.cross(draw_rotation(random) * Eigen::Vector3d::UnitX()).normalized();
  }
  const Eigen::Vector3d root = middle + extent_along(mesh_L, middle, direction) * direction;
  if (kind == DrawnKind::cable_box) {
    add_box(root, direction, {random(0.08, 0.14), random(0.08, 0.14), random(0.07, 0.12)}, thing);
    return thing;
  }
  add_box(root, direction, {random(0.05, 0.1), random(0.05, 0.1), random(0.12, 0.22)}, thing);
  if (kind == DrawnKind::bent_tool) {
    const DrawnThing::Piece stem = thing.pieces[0];
    const Eigen::Vector3d end = stem.X_LP * Eigen::Vector3d(0, 0, stem.size_m.z() / 2 - 0.03);
    add_box(end, stem.X_LP.linear().col(0), {0.06, stem.size_m.y(), random(0.12, 0.18)}, thing);
  }
  return thing;
}

RobotPose pose_at(const RobotModel& model, const std::vector<double>& positions) {
  RobotPose pose;
  forward_kinematics(model, positions, pose);
  return pose;
}

RobotExtent reach_of(const std::vector<RobotPose>& poses, const RobotModel& model) {
  RobotExtent reach = extent_of(model, poses[0]);
  for (const RobotPose& pose : poses) {
    const RobotExtent robot = extent_of(model, pose);
    reach.radius_m =
        std::max(reach.radius_m, (robot.centre_B_m - reach.centre_B_m).norm() + robot.radius_m);
    reach.lowest_z_m = std::min(reach.lowest_z_m, robot.lowest_z_m);
  }
  return reach;
}

void add_cameras(Random& random, const RobotModel& carrying, const std::vector<RobotPose>& poses,
                 int cameras, CarryingRobotSettings& settings) {
  const RobotExtent robot = extent_of(carrying, poses[0]);
  settings.camera = draw_camera(random, 640, 480);
  for (int i = 0; i < kMostTries && settings.X_BC.size() < static_cast<std::size_t>(cameras); ++i) {
    const Pose X_BC = draw_camera_pose(random, robot);
    const bool is_seen = std::ranges::all_of(poses, [&](const RobotPose& pose) {
      return robot_share(cast_image(EmbreeRenderer(carrying, pose, X_BC, settings.camera),
                                    settings.camera)) > kLeastSeenShare;
    });
    if (is_seen) settings.X_BC.push_back(X_BC);
  }
  if (settings.X_BC.size() < static_cast<std::size_t>(cameras)) {
    throw std::runtime_error("no camera sees robot " + carrying.name);
  }
}

void add_walls(const RobotExtent& reach, std::vector<DrawnObstacle>& room) {
  const double half_m = 4.5 * reach.radius_m;
  const auto wall = [&](const Eigen::Vector3d& size_m, double x, double y, double z) {
    const Eigen::Vector3d p = reach.centre_B_m + Eigen::Vector3d(x, y, 0);
    room.push_back({make_box(size_m), Pose(Eigen::Translation3d(p.x(), p.y(), z))});
  };
  wall({4 * half_m, 4 * half_m, 0.1}, 0, 0, reach.lowest_z_m - 0.1);
  for (const double side : {-1.0, 1.0}) {
    wall({0.1, 4 * half_m, 4 * half_m}, side * half_m, 0, 0);
    wall({4 * half_m, 0.1, 4 * half_m}, 0, side * half_m, 0);
  }
}

bool is_clear(const DrawnObstacle& thing, const RobotModel& carrying,
              const std::vector<MeshTree>& trees, const std::vector<RobotPose>& poses) {
  const MeshTree tree = build_mesh_tree(thing.mesh_O);
  for (const RobotPose& pose : poses) {
    for (std::size_t i = 0; i < carrying.links.size(); ++i) {
      if (closest_points(trees[i], pose.X_BL[i], tree, thing.X_BO, kClearance_m).distance_m <
          kClearance_m) {
        return false;
      }
    }
  }
  return true;
}

/// Around the robot's reach, and within it wherever there is room.
void add_things(Random& random, const RobotModel& carrying, const std::vector<RobotPose>& poses,
                const RobotExtent& reach, CarryingRobotSettings& settings) {
  const std::vector<MeshTree> trees = build_link_trees(carrying);
  const auto add = [&](double radius_m, const Eigen::Vector3d& p_B_m) {
    DrawnObstacle thing{draw_obstacle(random, radius_m), Pose(draw_rotation(random))};
    thing.X_BO.translation() = p_B_m;
    const bool hides = std::ranges::any_of(settings.X_BC, [&](const Pose& X_BC) {
      return (X_BC.translation() - p_B_m).norm() < radius_m + kLeastCameraClearance_m;
    });
    if (hides || !is_clear(thing, carrying, trees, poses)) return false;
    settings.room.push_back(std::move(thing));
    return true;
  };
  for (int i = 0; i < kThingsAround; ++i) {
    const double radius_m = reach.radius_m * random(0.1, 0.3);
    const Eigen::Vector3d direction = draw_rotation(random) * Eigen::Vector3d::UnitX();
    add(radius_m, reach.centre_B_m + (1.1 * reach.radius_m + radius_m) * direction);
  }
  int beside = 0;
  for (int i = 0; i < kMostTries && beside < kThingsBeside; ++i) {
    const double radius_m = reach.radius_m * random(0.05, 0.2);
    const Eigen::Vector3d direction = draw_rotation(random) * Eigen::Vector3d::UnitX();
    beside += add(radius_m, reach.centre_B_m + reach.radius_m * random(0.1, 0.9) * direction);
  }
}

}  // namespace

TriangleMesh DrawnThing::mesh_L() const {
  TriangleMesh mesh;
  for (const Piece& piece : pieces) {
    mesh.append(make_box(piece.size_m), Eigen::Affine3d(piece.X_LP));
  }
  return mesh;
}

double DrawnThing::distance_m(const Eigen::Vector3d& p_L_m) const {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces) {
    const Eigen::Vector3d p = (piece.X_LP.inverse() * p_L_m).cwiseAbs() - piece.size_m / 2;
    nearest_m = std::min(nearest_m, p.cwiseMax(0).norm());
  }
  return nearest_m;
}

DrawnCarryingCell draw_carrying_cell(const RobotModel& model, DrawnKind kind, int poses,
                                     int cameras, std::uint32_t seed) {
  Random random(seed);
  DrawnCarryingCell cell{draw_thing(random, model, kind), {}};
  RobotModel carrying = model;
  if (!cell.thing.pieces.empty()) {
    cell.settings.carried = {
        {"thing", model.links[cell.thing.link].name, cell.thing.mesh_L(), Pose::Identity(), true}};
    carrying = with_attachment(model, cell.settings.carried[0]);
  }
  std::vector<RobotPose> posed;
  for (int i = 0; i < poses; ++i) {
    cell.settings.positions.push_back(draw_joints(random, model).position);
    posed.push_back(pose_at(carrying, cell.settings.positions.back()));
  }
  const RobotExtent reach = reach_of(posed, carrying);
  add_cameras(random, carrying, posed, cameras, cell.settings);
  add_walls(reach, cell.settings.room);
  add_things(random, carrying, posed, reach, cell.settings);
  return cell;
}

}  // namespace berth::sim
