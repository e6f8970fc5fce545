#include "berth/robot/primitives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "berth/robot/soft_body.hpp"
#include "berth/robot/surface.hpp"
#include "sim/random.hpp"
#include "tests/support/thinned.hpp"

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

TriangleMesh box_at(const Eigen::Vector3d& size_m, const Eigen::Vector3d& centre_m) {
  TriangleMesh mesh;
  mesh.append(make_box(size_m), Eigen::Affine3d(Eigen::Translation3d(centre_m)));
  return mesh;
}

TEST(Surface, CentreDoesNotDependOnHowTheSurfaceIsCut) {
  TriangleMesh mesh = box_at({1, 2, 3}, {0.5, -1, 4});
  EXPECT_LT((surface_centre_m(mesh) - Eigen::Vector3d(0.5, -1, 4)).norm(), 1e-6);
  // One triangle in three, which add vertices on one side alone.
  const auto [a, b, c] = mesh.triangles.back();
  const auto middle = static_cast<std::uint32_t>(mesh.vertices_m.size());
  mesh.vertices_m.push_back((mesh.vertices_m[a] + mesh.vertices_m[b] + mesh.vertices_m[c]) / 3);
  mesh.triangles.back() = {a, b, middle};
  mesh.triangles.push_back({b, c, middle});
  mesh.triangles.push_back({c, a, middle});
  EXPECT_LT((surface_centre_m(mesh) - Eigen::Vector3d(0.5, -1, 4)).norm(), 1e-6);
}

TEST(Surface, CentreOfAMeshWithoutAreaIsThatOfItsVertices) {
  const TriangleMesh line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(surface_centre_m(line), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(surface_centre_m({}), Eigen::Vector3d::Zero());
}

TEST(Surface, ScaledMeshKeepsItsCentre) {
  const Eigen::AlignedBox3f box = scaled(box_at({1, 2, 4}, {3, 0, 0}), 6).bounding_box_m();
  EXPECT_LT((box.min() - Eigen::Vector3f(0, -6, -12)).norm(), 1e-5);
  EXPECT_LT((box.max() - Eigen::Vector3f(6, 6, 12)).norm(), 1e-5);
}

TEST(Surface, NormalsPointOutwardAndAreSharedByVerticesAtOnePlace) {
  const TriangleMesh box = make_box({2, 2, 2});
  TriangleMesh soup;
  for (const auto& triangle : box.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices_m.size());
    for (const std::uint32_t i : triangle) soup.vertices_m.push_back(box.vertices_m[i]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const std::vector<Eigen::Vector3f> normals = vertex_normals(soup);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_NEAR(normals[i].norm(), 1, 1e-6);
    EXPECT_GT(normals[i].dot(soup.vertices_m[i].normalized()), 0.8);
    for (std::size_t k = 0; k < i; ++k) {
      if (soup.vertices_m[i] != soup.vertices_m[k]) continue;
      EXPECT_EQ(normals[i], normals[k]);
    }
  }
}

Eigen::Vector3f point_in(const Eigen::Vector3d& half_m, sim::Random& random) {
  return Eigen::Vector3d(random(-1, 1) * half_m.x(), random(-1, 1) * half_m.y(),
                         random(-1, 1) * half_m.z())
      .cast<float>();
}

/// How far inside it is; negative outside.
double depth_in_box_m(const Eigen::Vector3f& p_m, const Eigen::Vector3d& half_m) {
  return (half_m - p_m.cast<double>().cwiseAbs()).minCoeff();
}

constexpr double kColumn_m = 0.005;

TEST(SoftBody, HoldsWhatItsMeshEncloses) {
  const Eigen::Vector3d half_m(0.11, 0.2, 0.031);
  const SoftBody box(0, make_box(2 * half_m));
  const SoftBody ball(0, make_sphere(0.2));
  sim::Random random(1);
  int inside = 0;
  for (int i = 0; i < thinned(20'000); ++i) {
    const Eigen::Vector3f p_m = point_in(1.2 * half_m, random);
    const double depth_m = depth_in_box_m(p_m, half_m);
    if (std::abs(depth_m) > kColumn_m) {
      EXPECT_EQ(box.contains(p_m), depth_m > 0) << p_m.transpose();
    }
    inside += depth_m > 0;
    const Eigen::Vector3f q_m = point_in(Eigen::Vector3d::Constant(0.24), random);
    // The ball has flat sides.
    if (q_m.norm() < 0.19F) {
      EXPECT_TRUE(ball.contains(q_m)) << q_m.transpose();
    }
    if (q_m.norm() > 0.21F) {
      EXPECT_FALSE(ball.contains(q_m)) << q_m.transpose();
    }
  }
  EXPECT_GT(inside, thinned(8'000));
}

TEST(SoftBody, MayHaveRoomInside) {
  TriangleMesh tube = make_sphere(0.2);
  tube.append(make_sphere(0.1), Eigen::Affine3d::Identity());
  const SoftBody body(0, tube);
  EXPECT_FALSE(body.contains({0.01F, 0.02F, 0.03F}));
  EXPECT_TRUE(body.contains({0.01F, 0.02F, 0.15F}));
}

TEST(SoftBody, LongOnesHaveWiderColumns) {
  const SoftBody body(0, make_cylinder(3, 0.4));
  EXPECT_TRUE(body.contains({2.9F, 0.3F, 0.1F}));
  EXPECT_FALSE(body.contains({2.9F, 0.9F, 0.1F}));
}

TEST(SoftBody, AMeshThatIsNotClosedIsRefused) {
  for (const TriangleMesh& closed : {make_box({0.1, 0.1, 0.1}), make_cylinder(0.1, 0.3)}) {
    for (std::size_t i = 0; i < closed.triangles.size(); ++i) {
      TriangleMesh open = closed;
      open.triangles.erase(open.triangles.begin() + static_cast<std::ptrdiff_t>(i));
      EXPECT_THROW(SoftBody(0, open), std::invalid_argument) << i;
    }
  }
}

}  // namespace
}  // namespace berth
