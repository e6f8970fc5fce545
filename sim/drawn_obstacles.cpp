#include "sim/drawn_obstacles.hpp"

#include <cmath>
#include <numbers>

#include "berth/robot/primitives.hpp"

namespace berth::sim {
namespace {

TriangleMesh draw_box(Random& random, double radius_m) {
  const Eigen::Vector3d size(random(0.1, 1), random(0.1, 1), random(0.1, 1));
  return make_box(size * (2 * radius_m / size.norm()));
}

TriangleMesh draw_cylinder(Random& random, double radius_m) {
  const double slope = random(0.1, 1.4);
  return make_cylinder(radius_m * std::sin(slope), 2 * radius_m * std::cos(slope));
}

/// A sphere with waves: not convex, and no two sides alike.
TriangleMesh draw_lump(Random& random, double radius_m) {
  TriangleMesh mesh = make_sphere(1);
  const Eigen::Vector3d waves(random(2, 6), random(2, 6), random(2, 6));
  const double phase = random(0, 6);
  for (Eigen::Vector3f& vertex : mesh.vertices_m) {
    const Eigen::Vector3d p = vertex.cast<double>().normalized();
    const double height = 0.7 + 0.3 * std::sin(waves.dot(p) + phase);
    vertex = (radius_m * height * p).cast<float>();
  }
  return mesh;
}

/// A plate on three legs.
TriangleMesh draw_stool(Random& random, double radius_m) {
  const double half_m = radius_m * random(0.45, 0.7);
  const double thick_m = 0.15 * half_m;
  const double leg_m = std::sqrt(radius_m * radius_m - 2 * half_m * half_m);
  TriangleMesh mesh = make_box({2 * half_m, 2 * half_m, thick_m});
  const Eigen::Vector3d leg_size(thick_m, thick_m, leg_m);
  for (const auto& [x, y] : {std::pair(1, 1), std::pair(1, -1), std::pair(-1, 0)}) {
    const Eigen::Vector3d centre(x * (half_m - thick_m / 2), y * (half_m - thick_m / 2),
                                 -leg_m / 2);
    mesh.append(make_box(leg_size), Eigen::Affine3d(Eigen::Translation3d(centre)));
  }
  return mesh;
}

}  // namespace

TriangleMesh draw_obstacle(Random& random, double radius_m) {
  switch (random.whole(0, 4)) {
    case 0:
      return draw_box(random, radius_m);
    case 1:
      return make_sphere(radius_m);
    case 2:
      return draw_cylinder(random, radius_m);
    case 3:
      return draw_lump(random, radius_m);
    default:
      return draw_stool(random, radius_m);
  }
}

Eigen::Quaterniond draw_rotation(Random& random) {
  const double w = random.gaussian();
  const double x = random.gaussian();
  const double y = random.gaussian();
  return Eigen::Quaterniond(w, x, y, random.gaussian()).normalized();
}

}  // namespace berth::sim
