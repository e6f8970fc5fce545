#include "sim/contact_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "berth/robot/primitives.hpp"
#include "sim/drawn_obstacles.hpp"
#include "sim/drawn_person.hpp"
#include "sim/shapes.hpp"
#include "sim/turn_between.hpp"

namespace berth::sim {
namespace {

using Eigen::Vector3d;

constexpr int kMostTries = 300;
/// From the robot's middle to the walls.
constexpr double kRoomHalf_m = 3.2;
constexpr double kWall_m = 0.1;
constexpr double kLeastSeen_m2 = 0.001;

std::vector<PosedMesh> posed_robot(const RobotModel& model, const RobotPose& pose) {
  std::vector<PosedMesh> links;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    if (link.role == LinkRole::ignored || link.mesh_L.empty()) continue;
    links.push_back({&link.mesh_L, pose.X_BL[i]});
  }
  return links;
}

std::vector<PosedMesh> posed_world(const ContactScene& scene, bool has_things,
                                   std::uint32_t& first_thing) {
  std::vector<PosedMesh> all = posed_robot(scene.model, scene.pose);
  for (const DrawnObstacle& wall : scene.room) all.push_back({&wall.mesh_O, wall.X_BO});
  first_thing = static_cast<std::uint32_t>(all.size());
  if (!has_things) return all;
  for (const DrawnObstacle& thing : scene.things) all.push_back({&thing.mesh_O, thing.X_BO});
  return all;
}

/// Each moved link with a surface as likely as the others.
std::size_t draw_moved_link(Random& random, const RobotModel& model) {
  std::vector<std::size_t> moved;
  for (const std::size_t i : model.evaluated_links) {
    if (model.is_moved(i) && model.links[i].mesh_L.bounding_box_m().diagonal().norm() > 0.06F) {
      moved.push_back(i);
    }
  }
  return moved[random.whole(0, static_cast<int>(moved.size()) - 1)];
}

struct SurfacePoint {
  Vector3d p_B_m;
  Vector3d normal_B;
};

/// On the robot's outside, where nothing of it stands before the surface; none: nothing was found.
std::optional<SurfacePoint> draw_surface_point(Random& random, const ContactScene& scene) {
  constexpr double kOff_m = 0.002, kOpen_m = 0.2;
  const std::size_t link = draw_moved_link(random, scene.model);
  const TriangleMesh& mesh_L = scene.model.links[link].mesh_L;
  std::vector<double> area_m2 = {0};
  const auto corner = [&](const auto& triangle, int k) -> Vector3d {
    return mesh_L.vertices_m[triangle[k]].template cast<double>();
  };
  const auto normal_of = [&](const auto& t) -> Vector3d {
    return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
  };
  for (const auto& t : mesh_L.triangles) area_m2.push_back(area_m2.back() + normal_of(t).norm());
  const RayCaster robot(posed_robot(scene.model, scene.pose), Pose::Identity(), {1, 1, 1, 1, 0, 0},
                        EmbreeThreads::one);
  for (int i = 0; i < 20; ++i) {
    const double at_m2 = random(0, area_m2.back());
    const auto place = std::upper_bound(area_m2.begin() + 1, area_m2.end() - 1, at_m2);
    const auto& t = mesh_L.triangles[place - area_m2.begin() - 1];
    const double a = std::sqrt(random(0, 1)), b = random(0, 1);
    const Vector3d p_L = (1 - a) * corner(t, 0) + a * (1 - b) * corner(t, 1) + a * b * corner(t, 2);
    const double side = random.chance(0.5) ? 1 : -1;
    const SurfacePoint point{scene.pose.X_BL[link] * p_L,
                             scene.pose.X_BL[link].linear() * normal_of(t).normalized() * side};
    const auto off = [&](double m) { return (point.p_B_m + m * point.normal_B).cast<float>(); };
    if (!robot.is_blocked(off(kOff_m), off(kOpen_m))) return point;
  }
  return std::nullopt;
}

double distance_m(const std::vector<MeshTree>& link_trees, const ContactScene& scene,
                  const DrawnObstacle& thing, double less_than_m) {
  const MeshTree tree = build_mesh_tree(thing.mesh_O);
  double least_m = less_than_m;
  for (const std::size_t i : scene.model.evaluated_links) {
    least_m = std::min(
        least_m,
        closest_points(link_trees[i], scene.pose.X_BL[i], tree, thing.X_BO, least_m).distance_m);
  }
  return least_m;
}

/// Axis z along the normal, turned about it at random.
Pose pose_on(Random& random, const SurfacePoint& at, double height_m) {
  Pose X = Pose(turn_between(Vector3d::UnitZ(), at.normal_B)) *
           rotation(random(-std::numbers::pi, std::numbers::pi), Vector3d::UnitZ());
  X.translation() = at.p_B_m + height_m * at.normal_B;
  return X;
}

/// Away from the robot until it no longer cuts into it, and by the gap. False: it does not fit.
bool move_off(const std::vector<MeshTree>& link_trees, const ContactScene& scene,
              const Vector3d& normal_B, double gap_m, DrawnObstacle& thing) {
  constexpr double kStep_m = 0.002, kMost_m = 0.1;
  for (double way_m = 0; way_m < kMost_m; way_m += kStep_m) {
    if (distance_m(link_trees, scene, thing, 1e-4) > 0) {
      thing.X_BO.translation() += gap_m * normal_B;
      return distance_m(link_trees, scene, thing, 1e-4) > 0;
    }
    thing.X_BO.translation() += kStep_m * normal_B;
  }
  return false;
}

TriangleMesh draw_hand(Random& random, double thickness_m) {
  const double length_m = random(0.15, 0.18), width_m = random(0.085, 0.1);
  if (random.chance(0.5)) return make_cuboid({length_m, width_m, thickness_m});
  return make_ellipsoid({length_m / 2, width_m / 2, thickness_m / 2}, 24);
}

/// Its least edge is along z.
Vector3d draw_box_size_m(Random& random) {
  switch (random.whole(0, 2)) {
    case 0:
      return {random(0.14, 0.2), random(0.08, 0.12), random(0.04, 0.06)};
    case 1:
      return Vector3d::Constant(random(0.04, 0.1));
    default:
      return {random(0.2, 0.4), 0.04, 0.04};
  }
}

bool put_at_arm(Random& random, const std::vector<MeshTree>& link_trees, ContactKind kind,
                ContactScene& scene) {
  const auto at = draw_surface_point(random, scene);
  if (!at) return false;
  DrawnObstacle thing;
  double gap_m = 0;
  if (kind == ContactKind::hand_on_arm) {
    scene.thickness_m = random(0.025, 0.06);
    thing.mesh_O = draw_hand(random, scene.thickness_m);
  } else {
    const Vector3d size_m = draw_box_size_m(random);
    scene.thickness_m = size_m.z();
    thing.mesh_O = make_cuboid(size_m);
    gap_m = random.chance(0.5) ? 0 : random(0, 0.03);
  }
  thing.X_BO = pose_on(random, *at, scene.thickness_m / 2);
  scene.things.push_back(thing);
  return move_off(link_trees, scene, at->normal_B, gap_m, scene.things.back());
}

/// A table top below one of the links, clear of all.
bool put_table(Random& random, const std::vector<MeshTree>& link_trees, ContactScene& scene,
               Vector3d& below_B_m) {
  constexpr double kClear_m = 0.02, kTop_m = 0.03;
  const std::size_t link = draw_moved_link(random, scene.model);
  Vector3d lowest_B_m = Vector3d::Constant(1e3);
  for (const auto& vertex : scene.model.links[link].mesh_L.vertices_m) {
    const Vector3d p_B_m = scene.pose.X_BL[link] * vertex.cast<double>();
    if (p_B_m.z() < lowest_B_m.z()) lowest_B_m = p_B_m;
  }
  below_B_m = lowest_B_m - random(0.06, 0.2) * Vector3d::UnitZ();
  DrawnObstacle top{make_box({0.6, 0.6, kTop_m}), Pose::Identity()};
  top.X_BO.translation() = below_B_m - kTop_m / 2 * Vector3d::UnitZ();
  if (distance_m(link_trees, scene, top, kClear_m) < kClear_m) return false;
  Link table;
  table.name = "drawn_table";
  table.parent = 0;
  table.joint.name = "drawn_table_joint";
  table.joint.X_PJ = top.X_BO;
  table.role = LinkRole::environment;
  table.id = kEnvironmentLink;
  table.mesh_L = top.mesh_O;
  scene.model.links.push_back(table);
  forward_kinematics(scene.model, scene.joints.position, scene.pose);
  return true;
}

bool put_on_table(Random& random, const std::vector<MeshTree>& link_trees, ContactScene& scene) {
  Vector3d below_B_m;
  if (!put_table(random, link_trees, scene, below_B_m)) return false;
  scene.thickness_m = random(0.025, 0.06);
  const auto lying = [&](double height_m, double reach_m) {
    const Vector3d aside_m(random(-reach_m, reach_m), random(-reach_m, reach_m), height_m);
    return translation(below_B_m.x() + aside_m.x(), below_B_m.y() + aside_m.y(),
                       below_B_m.z() + aside_m.z()) *
           rotation(random(-std::numbers::pi, std::numbers::pi), Vector3d::UnitZ());
  };
  DrawnObstacle hand{draw_hand(random, scene.thickness_m), lying(scene.thickness_m / 2, 0.06)};
  if (random.chance(0.5)) {
    const double radius_m = random(0.035, 0.045);
    append(hand.mesh_O, make_capsule(0.35, radius_m, radius_m, 24),
           translation(0.09, 0, radius_m - scene.thickness_m / 2) *
               rotation(std::numbers::pi / 2, Vector3d::UnitY()));
  }
  scene.things.push_back(hand);
  for (int i = random.whole(0, 3); i > 0; --i) {
    const double edge_m = random(0.04, 0.07);
    scene.things.push_back({make_cuboid(Vector3d::Constant(edge_m)), lying(edge_m / 2, 0.27)});
  }
  return std::ranges::all_of(scene.things, [&](const DrawnObstacle& thing) {
    return distance_m(link_trees, scene, thing, 1e-4) > 0;
  });
}

/// Upright, so near to the robot.
bool put_person(const std::vector<MeshTree>& link_trees, TriangleMesh person_B, double least_m,
                double most_m, ContactScene& scene) {
  scene.things.push_back({std::move(person_B), Pose::Identity()});
  const double near_m = distance_m(link_trees, scene, scene.things.back(), most_m);
  return near_m > least_m && near_m < most_m;
}

Vector3d draw_place_near(Random& random, const ContactScene& scene, double least_m, double most_m) {
  const std::size_t link = draw_moved_link(random, scene.model);
  const double around = random(-std::numbers::pi, std::numbers::pi),
               far_m = random(least_m, most_m);
  return scene.pose.X_BL[link].translation() +
         far_m * Vector3d(std::cos(around), std::sin(around), 0);
}

bool put_black(Random& random, const std::vector<MeshTree>& link_trees, ContactScene& scene) {
  scene.thickness_m = 0.1;
  if (random.chance(0.5)) {
    const Vector3d place_B_m = draw_place_near(random, scene, 0.2, 0.6);
    return put_person(link_trees, draw_person(random, place_B_m), 0.03, 0.15, scene);
  }
  const auto at = draw_surface_point(random, scene);
  if (!at) return false;
  constexpr double kRadius_m = 0.05, kLength_m = 0.6;
  DrawnObstacle sleeve;
  append(sleeve.mesh_O, make_capsule(kLength_m, kRadius_m, kRadius_m, 24),
         rotation(std::numbers::pi / 2, Vector3d::UnitY()) * translation(0, 0, -kLength_m / 2));
  sleeve.X_BO = pose_on(random, *at, kRadius_m);
  scene.things.push_back(sleeve);
  return move_off(link_trees, scene, at->normal_B, random(0.02, 0.08), scene.things.back());
}

bool put_beside(Random& random, const std::vector<MeshTree>& link_trees, ContactScene& scene) {
  scene.thickness_m = 0.4;
  const Vector3d place_B_m = draw_place_near(random, scene, 0.25, 0.7);
  TriangleMesh body_B;
  append(body_B, make_cylinder(0.2, 1.8), translation(place_B_m.x(), place_B_m.y(), place_B_m.z()));
  return put_person(link_trees, body_B, 0.05, 0.3, scene);
}

bool put_things(Random& random, const std::vector<MeshTree>& link_trees, ContactKind kind,
                ContactScene& scene) {
  switch (kind) {
    case ContactKind::box_at_arm:
    case ContactKind::hand_on_arm:
      return put_at_arm(random, link_trees, kind, scene);
    case ContactKind::hand_on_table:
      return put_on_table(random, link_trees, scene);
    case ContactKind::black:
      return put_black(random, link_trees, scene);
    case ContactKind::beside_images:
      break;
  }
  return put_beside(random, link_trees, scene);
}

void add_closed_room(const RobotExtent& robot, ContactScene& scene) {
  const Vector3d centre_B_m(robot.centre_B_m.x(), robot.centre_B_m.y(),
                            robot.lowest_z_m - 0.05 + kRoomHalf_m);
  for (int axis = 0; axis < 3; ++axis) {
    Vector3d size_m = Vector3d::Constant(2 * kRoomHalf_m + 2 * kWall_m);
    size_m[axis] = kWall_m;
    for (const double side : {-1.0, 1.0}) {
      DrawnObstacle wall{make_box(size_m), Pose::Identity()};
      wall.X_BO.translation() = centre_B_m;
      wall.X_BO.translation()[axis] += side * (kRoomHalf_m + kWall_m / 2);
      scene.room.push_back(std::move(wall));
    }
  }
}

/// How much of thing and robot a camera sees.
struct Shown {
  double thing_m2 = 0;
  int robot_px = 0;
  double nearest_m = 1e3;
};
Shown shown_in(const ContactScene& scene, const ContactView& view) {
  const ContactRays rays(scene, view, true);
  const auto robot_meshes = posed_robot(scene.model, scene.pose).size();
  const Camera& camera = view.camera;
  Shown shown;
  for (int v = 0; v < camera.height_px; v += 2) {
    for (int u = 0; u < camera.width_px; u += 2) {
      const SurfaceHit hit = rays.rays().hit(u, v);
      if (hit.mesh == kNoMesh) continue;
      shown.nearest_m = std::min<double>(shown.nearest_m, hit.depth_m);
      shown.robot_px += hit.mesh < robot_meshes ? 4 : 0;
      if (!rays.shows_thing(hit)) continue;
      shown.thing_m2 += 4 * hit.depth_m * hit.depth_m / (camera.fx_px * camera.fy_px);
    }
  }
  return shown;
}

/// Cameras in the room that see some of the robot; false where they do not show the things as
/// their kind asks.
bool put_cameras(Random& random, const RobotExtent& robot, const ContactSettings& settings,
                 ContactScene& scene) {
  const bool is_beside = settings.kind == ContactKind::beside_images;
  bool is_seen = is_beside;
  for (int tries = 0; tries < 20 * settings.cameras; ++tries) {
    ContactView view{draw_camera(random, settings.width_px, settings.height_px),
                     draw_camera_pose(random, robot)};
    const double wide = random(is_beside ? 1.4 : 0.75, is_beside ? 2.0 : 1.1);
    view.camera.fx_px = view.camera.fy_px = wide * settings.width_px;
    const Vector3d off_m = view.X_BC.translation() - scene.room.front().X_BO.translation();
    if (off_m.x() < 0.3 || off_m.x() > 2 * kRoomHalf_m - 0.2 || off_m.z() > kRoomHalf_m - 0.2 ||
        std::abs(off_m.y()) > kRoomHalf_m - 0.2 || off_m.z() < 0.2 - kRoomHalf_m) {
      continue;
    }
    const Shown shown = shown_in(scene, view);
    const int pixels = settings.width_px * settings.height_px;
    if (shown.robot_px < kLeastRobotShare * pixels || shown.nearest_m < kLeastCameraClearance_m) {
      continue;
    }
    if (is_beside && shown.thing_m2 > 0) continue;
    is_seen = is_seen || shown.thing_m2 > kLeastSeen_m2;
    scene.views.push_back(view);
    if (static_cast<int>(scene.views.size()) == settings.cameras) return is_seen;
  }
  return false;
}

/// In the image, and not behind the robot.
bool covers(const ContactScene& scene, const ContactView& view, const ContactRays& rays,
            const Vector3d& p_B_m) {
  constexpr double kAtSurface_m = 0.01;
  const Vector3d p_C = view.X_BC.inverse() * p_B_m;
  if (p_C.z() <= 0) return false;
  const Camera& camera = view.camera;
  const double u = camera.fx_px * p_C.x() / p_C.z() + camera.cx_px;
  const double v = camera.fy_px * p_C.y() / p_C.z() + camera.cy_px;
  if (u < 0 || v < 0 || u > camera.width_px - 1 || v > camera.height_px - 1) return false;
  const SurfaceHit hit = rays.rays().hit(u, v);
  return hit.mesh >= posed_robot(scene.model, scene.pose).size() ||
         hit.depth_m > p_C.z() - kAtSurface_m;
}

void measure_truth(const std::vector<MeshTree>& link_trees, ContactScene& scene) {
  std::vector<DrawnObstacle> all = scene.room;
  all.insert(all.end(), scene.things.begin(), scene.things.end());
  std::vector<MeshTree> trees;
  for (const DrawnObstacle& obstacle : all) trees.push_back(build_mesh_tree(obstacle.mesh_O));
  std::vector<std::unique_ptr<ContactRays>> rays;
  for (const ContactView& view : scene.views) {
    rays.push_back(std::make_unique<ContactRays>(scene, view, true));
  }
  for (const std::size_t i : scene.model.evaluated_links) {
    SurfacePair nearest;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const SurfacePair pair = closest_points(link_trees[i], scene.pose.X_BL[i], trees[k],
                                              all[k].X_BO, nearest.distance_m);
      if (pair.distance_m < nearest.distance_m) nearest = pair;
    }
    bool is_covered = false;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      is_covered = is_covered || covers(scene, scene.views[k], *rays[k], nearest.b_m);
    }
    scene.truth_m.push_back(nearest.distance_m);
    scene.is_covered.push_back(is_covered);
  }
}

}  // namespace

ContactRays::ContactRays(const ContactScene& scene, const ContactView& view, bool has_things)
    : rays_(posed_world(scene, has_things, first_thing_), view.X_BC, view.camera,
            EmbreeThreads::one) {}

ContactScene draw_contact(const RobotModel& model, const std::vector<MeshTree>& link_trees,
                          const ContactSettings& settings, std::uint32_t seed) {
  Random random(seed);
  for (int tries = 0; tries < kMostTries; ++tries) {
    ContactScene scene;
    scene.model = model;
    scene.joints = draw_joints(random, model);
    forward_kinematics(model, scene.joints.position, scene.pose);
    if (!put_things(random, link_trees, settings.kind, scene)) continue;
    const RobotExtent robot = extent_of(scene.model, scene.pose);
    add_closed_room(robot, scene);
    if (!put_cameras(random, robot, settings, scene)) continue;
    measure_truth(link_trees, scene);
    return scene;
  }
  throw std::runtime_error(fmt::format("robot \"{}\": none of {} scenes has a {} that is shown",
                                       model.name, kMostTries,
                                       kContactKindNames[static_cast<std::size_t>(settings.kind)]));
}

}  // namespace berth::sim
