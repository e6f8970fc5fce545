// Balls and points of links, against points drawn on their surfaces.
#include "berth/distance/link_balls.hpp"

#include <gtest/gtest.h>

#include "sim/random.hpp"
#include "tests/support/known_arms.hpp"

namespace berth::mesh {
namespace {

bool holds(const EightBalls& balls, std::size_t i, const Eigen::Vector3f& p_m) {
  const Eigen::Vector3f centre_m(balls.x_m[i], balls.y_m[i], balls.z_m[i]);
  return (p_m - centre_m).norm() <= balls.radius_m[i];
}

Eigen::Vector3f draw_on(const TriangleMesh& mesh, sim::Random& random) {
  const auto at = random.whole(0, static_cast<int>(mesh.triangles.size()) - 1);
  const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(at)];
  double s = random(0, 1), t = random(0, 1);
  if (s + t > 1) s = 1 - s, t = 1 - t;
  return (mesh.vertices_m[a].cast<double>() +
          s * (mesh.vertices_m[b] - mesh.vertices_m[a]).cast<double>() +
          t * (mesh.vertices_m[c] - mesh.vertices_m[a]).cast<double>())
      .cast<float>();
}

/// How far the balls that hold a drawn point reach beyond it, in the mean.
double expect_covered(const TriangleMesh& mesh) {
  const LinkBalls balls = build_link_balls(mesh);
  sim::Random random(1);
  double radius_m = 0;
  constexpr int kPoints = 2000;
  for (int n = 0; n < kPoints; ++n) {
    const Eigen::Vector3f p_m = draw_on(mesh, random);
    EXPECT_LE((p_m - balls.centre_m).norm(), balls.radius_m);
    bool is_covered = false;
    for (std::size_t i = 0; i < 8; ++i) {
      if (!holds(balls.coarse, i, p_m)) continue;
      for (std::size_t k = 0; k < 8 && !is_covered; ++k) {
        is_covered = holds(balls.fine[i], k, p_m);
        if (is_covered) radius_m += balls.fine[i].radius_m[k];
      }
    }
    EXPECT_TRUE(is_covered) << p_m.transpose();
  }
  return radius_m / kPoints;
}

TEST(LinkBalls, HoldEachPointOfTheSurface) {
  const RobotModel model = load_robot(bundled_arm());
  for (const std::size_t link : model.evaluated_links) {
    SCOPED_TRACE(model.links[link].name);
    EXPECT_LT(expect_covered(model.links[link].mesh_L), 0.08);
  }
}

TEST(LinkBalls, OfOddMeshesToo) {
  TriangleMesh sheet;
  sheet.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  expect_covered(sheet);
  TriangleMesh needle;
  needle.vertices_m = {{0, 0, 0}, {0.5F, 0, 0}, {0.5F, 0, 0}};
  needle.triangles = {{0, 1, 2}};
  expect_covered(needle);
  TriangleMesh point;
  point.vertices_m = {{0.1F, 0, 0}};
  point.triangles = {{0, 0, 0}};
  expect_covered(point);
  for (const float radius_m : build_link_balls({}).coarse.radius_m) EXPECT_LT(radius_m, 0);
}

TEST(LinkBalls, TheirPointsLieOnTheSurface) {
  const RobotModel model = load_robot(bundled_arm());
  const TriangleMesh& mesh = model.links[model.evaluated_links.back()].mesh_L;
  const LinkBalls balls = build_link_balls(mesh);
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t k = 0; k < 8 && balls.coarse.radius_m[i] >= 0; ++k) {
      const EightBalls& points = balls.coarse_points[i];
      const Eigen::Vector3f p_m(points.x_m[k], points.y_m[k], points.z_m[k]);
      EXPECT_TRUE(holds(balls.coarse, i, p_m));
      // Distance to the nearest triangle's plane and box.
      float least_m = 1;
      for (const auto& [a, b, c] : mesh.triangles) {
        const Eigen::Vector3f &u = mesh.vertices_m[a], &v = mesh.vertices_m[b],
                              &w = mesh.vertices_m[c];
        const Eigen::Vector3f normal = (v - u).cross(w - u).normalized();
        const Eigen::Vector3f low = u.cwiseMin(v).cwiseMin(w), high = u.cwiseMax(v).cwiseMax(w);
        const Eigen::Vector3f beside = (low - p_m).cwiseMax(p_m - high).cwiseMax(0.0f);
        least_m = std::min(least_m, std::max(std::abs(normal.dot(p_m - u)), beside.norm()));
      }
      EXPECT_LT(least_m, 1e-5f);
    }
  }
}

}  // namespace
}  // namespace berth::mesh
