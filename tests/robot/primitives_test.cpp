#include "berth/robot/primitives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

namespace berth {
namespace {

/// The distance from the origin to the triangle's plane, along its normal.
double plane_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      const Eigen::Vector3d& c) {
  return std::abs((b - a).cross(c - a).normalized().dot(a));
}

/// Each edge belongs to two triangles: no hole for a ray to slip through.
void expect_closed(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
      ++uses[{low, high}];
    }
  }
  for (const auto& [edge, count] : uses) EXPECT_EQ(count, 2) << edge.first << " " << edge.second;
}

TEST(Primitives, BoxIsExactAndClosed) {
  const TriangleMesh box = make_box({1, 2, 4});
  EXPECT_EQ(box.bounding_box_m().min(), Eigen::Vector3f(-0.5F, -1, -2));
  EXPECT_EQ(box.bounding_box_m().max(), Eigen::Vector3f(0.5F, 1, 2));
  EXPECT_EQ(box.triangles.size(), 12U);
  expect_closed(box);
  for (const auto& [a, b, c] : box.triangles) {
    const double d =
        plane_distance(box.vertices_m[a].cast<double>(), box.vertices_m[b].cast<double>(),
                       box.vertices_m[c].cast<double>());
    EXPECT_TRUE(d == 0.5 || d == 1 || d == 2) << "a triangle inside the box: " << d;
  }
}

TEST(Primitives, CylinderHoldsTheTrueOneAndLeavesItByLittle) {
  constexpr double kRadius = 0.3;
  const TriangleMesh mesh = make_cylinder(kRadius, 2);
  expect_closed(mesh);
  EXPECT_EQ(mesh.bounding_box_m().min().z(), -1);
  EXPECT_EQ(mesh.bounding_box_m().max().z(), 1);
  for (const auto& p : mesh.vertices_m)
    EXPECT_LE(p.head<2>().norm(), kRadius * (1 + kMaxPrimitiveExcess));
  for (const auto& triangle : mesh.triangles) {
    // Seen along the axis, the walls are chords around the circle and the caps lie flat at the
    // ends.
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = mesh.vertices_m[triangle[i]].cast<double>();
    const double expected = p[0].z() == p[1].z() && p[1].z() == p[2].z() ? 1 : kRadius;
    EXPECT_GE(plane_distance(p[0], p[1], p[2]), expected - 1e-7);
  }
}

TEST(Primitives, SphereHoldsTheTrueOneAndLeavesItByLittle) {
  constexpr double kRadius = 0.7;
  const TriangleMesh mesh = make_sphere(kRadius);
  expect_closed(mesh);
  for (const auto& p : mesh.vertices_m) EXPECT_LE(p.norm(), kRadius * (1 + kMaxPrimitiveExcess));
  for (const auto& [a, b, c] : mesh.triangles) {
    EXPECT_GE(plane_distance(mesh.vertices_m[a].cast<double>(), mesh.vertices_m[b].cast<double>(),
                             mesh.vertices_m[c].cast<double>()),
              kRadius - 1e-6);
  }
}

}  // namespace
}  // namespace berth
