#include "berth/robot/primitives.hpp"

#include <cmath>
#include <numbers>

namespace berth {
namespace {

// cos(pi / 48) = 0.99786: a polygon of 48 sides around a circle leaves it by 0.0021 of the radius
// (a sphere: twice).
constexpr int kSegments = 48;
constexpr int kRings = 24;

/// Rings of kSegments corners each, then the two poles: walls between the rings and caps to the
/// poles.
void connect_rings(TriangleMesh& mesh, std::uint32_t rings) {
  const std::uint32_t n = kSegments;
  const std::uint32_t bottom = rings * n;
  const std::uint32_t top = bottom + 1;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    for (std::uint32_t r = 0; r + 1 < rings; ++r) {
      const std::uint32_t low = r * n;
      const std::uint32_t high = low + n;
      mesh.triangles.push_back({low + i, low + next, high + next});
      mesh.triangles.push_back({low + i, high + next, high + i});
    }
    mesh.triangles.push_back({bottom, next, i});
    mesh.triangles.push_back({top, (rings - 1) * n + i, (rings - 1) * n + next});
  }
}

void append_ring(TriangleMesh& mesh, double radius_m, double z_m) {
  for (int i = 0; i < kSegments; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSegments;
    mesh.vertices_m.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), z_m);
  }
}

}  // namespace

TriangleMesh make_box(const Eigen::Vector3d& size_m) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sign((corner & 1) ? 0.5 : -0.5, (corner & 2) ? 0.5 : -0.5,
                               (corner & 4) ? 0.5 : -0.5);
    mesh.vertices_m.push_back(size_m.cwiseProduct(sign).cast<float>());
  }
  mesh.triangles = {{0, 3, 1}, {0, 2, 3}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 7, 3}, {2, 6, 7}, {0, 6, 2}, {0, 4, 6}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh make_cylinder(double radius_m, double length_m) {
  TriangleMesh mesh;
  const double outer_m = radius_m / std::cos(std::numbers::pi / kSegments);
  append_ring(mesh, outer_m, -length_m / 2);
  append_ring(mesh, outer_m, length_m / 2);
  mesh.vertices_m.emplace_back(0, 0, -length_m / 2);
  mesh.vertices_m.emplace_back(0, 0, length_m / 2);
  connect_rings(mesh, 2);
  return mesh;
}

TriangleMesh make_sphere(double radius_m) { return make_capsule(radius_m, 0); }

TriangleMesh make_capsule(double radius_m, double length_m) {
  TriangleMesh mesh;
  // The caps' rings at half steps and both poles lie on a slightly larger sphere, so that no chord
  // between neighbours, in a ring or between rings, cuts into the true one.
  const double half_step = std::numbers::pi / kSegments;
  const double outer_m = radius_m / std::cos(half_step);
  const double step = std::numbers::pi / kRings;
  const double ring_m = outer_m / std::cos(half_step);
  const auto append_cap_ring = [&](int ring, double centre_m) {
    const double polar = std::numbers::pi - ring * step;
    append_ring(mesh, ring_m * std::sin(polar), centre_m + outer_m * std::cos(polar));
  };
  for (int ring = 1; ring <= kRings / 2; ++ring) append_cap_ring(ring, -length_m / 2);
  const int upper = length_m > 0 ? kRings / 2 : kRings / 2 + 1;
  for (int ring = upper; ring < kRings; ++ring) append_cap_ring(ring, length_m / 2);
  const std::size_t rings = mesh.vertices_m.size() / kSegments;
  mesh.vertices_m.emplace_back(0, 0, -length_m / 2 - outer_m);
  mesh.vertices_m.emplace_back(0, 0, length_m / 2 + outer_m);
  connect_rings(mesh, static_cast<std::uint32_t>(rings));
  return mesh;
}

}  // namespace berth
