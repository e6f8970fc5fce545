#include "sim/drawn_person.hpp"

#include <cmath>
#include <numbers>

#include "berth/render/robot_renderer.hpp"
#include "berth/robot/primitives.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/watch/seen_through.hpp"
#include "sim/drawn_obstacles.hpp"
#include "sim/sensor_model.hpp"
#include "sim/turn_between.hpp"

namespace berth::sim {
namespace {

using Eigen::Vector3d;

constexpr double kUpperArm_m = 0.30, kForearm_m = 0.35, kLeg_m = 0.85;

void append_capsule(const Vector3d& from_B_m, const Vector3d& to_B_m, double radius_m,
                    TriangleMesh& out) {
  const Vector3d along_m = to_B_m - from_B_m;
  const Eigen::Quaterniond turned = turn_between(Vector3d::UnitZ(), along_m);
  out.append(make_sphere(radius_m), Eigen::Affine3d(Eigen::Translation3d(from_B_m)));
  out.append(make_sphere(radius_m), Eigen::Affine3d(Eigen::Translation3d(to_B_m)));
  out.append(make_cylinder(radius_m, along_m.norm()),
             Eigen::Translation3d(from_B_m + along_m / 2) * turned);
}

Vector3d draw_direction(Random& random) { return draw_rotation(random) * Vector3d::UnitX(); }

/// The person as a robot of one link at the base.
RobotModel model_of(const TriangleMesh& person_B) {
  RobotModel model;
  Link link;
  link.role = LinkRole::evaluated;
  link.id = 1;
  link.mesh_L = person_B;
  model.links.push_back(link);
  model.evaluated_links = {0};
  return model;
}

}  // namespace

TriangleMesh draw_person(Random& random, const Vector3d& place_B_m) {
  TriangleMesh person_B;
  const double turn_rad = random(0, 2 * std::numbers::pi);
  const Vector3d left(std::cos(turn_rad), std::sin(turn_rad), 0);
  const Vector3d hips_m = place_B_m - random(-0.3, 0.6) * Vector3d::UnitZ();
  const Vector3d neck_m = hips_m + 0.5 * Vector3d::UnitZ();
  append_capsule(hips_m, neck_m, 0.16, person_B);
  append_capsule(neck_m + 0.2 * Vector3d::UnitZ(), neck_m + 0.25 * Vector3d::UnitZ(), 0.1,
                 person_B);
  for (const double side : {-1.0, 1.0}) {
    const Vector3d shoulder_m = neck_m + 0.2 * side * left;
    const Vector3d elbow_m = shoulder_m + kUpperArm_m * draw_direction(random);
    append_capsule(shoulder_m, elbow_m, 0.05, person_B);
    append_capsule(elbow_m, elbow_m + kForearm_m * draw_direction(random), 0.04, person_B);
    const Vector3d hip_m = hips_m + 0.1 * side * left;
    append_capsule(hip_m, hip_m - kLeg_m * Vector3d::UnitZ(), 0.08, person_B);
  }
  return person_B;
}

DepthImage with_person(const TriangleMesh& person_B, const Camera& camera, const Pose& X_BC,
                       const DepthImage& depth_m, const RobotImage& robot) {
  RobotRenderer renderer(build_link_meshes(model_of(person_B)), camera);
  RobotImage person;
  renderer.render(RobotPose{{Pose::Identity()}}, X_BC, person);
  DepthImage seen_m = depth_m;
  for (std::size_t i = 0; i < seen_m.pixels().size(); ++i) {
    // A pixel of the robot without a reading gets none from what stands behind the robot.
    const bool is_behind = person.depth_m.pixels()[i] > robot.depth_m.pixels()[i];
    if (is_behind) continue;
    seen_m.pixels()[i] = std::fmin(seen_m.pixels()[i], person.depth_m.pixels()[i]);
  }
  return seen_m;
}

DepthImage hide_robot(double share, const Camera& camera, const Pose& X_BC,
                      const Vector3d& robot_B_m, const DepthImage& depth_m, const RobotImage& robot,
                      std::uint32_t seed) {
  Random random(seed);
  DepthImage best_m = depth_m;
  double best_error = 1;
  for (int attempt = 0; attempt < 15 && best_error > 0.1; ++attempt) {
    const double way = random(0.25, 0.9);
    const Vector3d place_B_m =
        X_BC.translation() + way * (robot_B_m - X_BC.translation()) + draw_point(random, 0.4 * way);
    DepthImage seen_m = with_person(draw_person(random, place_B_m), camera, X_BC, depth_m, robot);
    const double hidden = read_robot(seen_m, robot).hidden_share();
    if (!(hidden <= 0.9 && std::abs(hidden - share) < best_error)) continue;
    best_error = std::abs(hidden - share);
    best_m = std::move(seen_m);
  }
  mix_edge_pixels(0.1, seed, best_m);
  return best_m;
}

}  // namespace berth::sim
