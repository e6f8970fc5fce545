#include "berth/visibility/sample_points.hpp"

#include <gtest/gtest.h>

#include "berth/robot/primitives.hpp"
#include "tests/render/small_robot.hpp"

namespace berth {
namespace {

TEST(SampleSurface, PartsOfTheSurfaceGetPointsByTheirArea) {
  // 3 x 2 x 1: faces of 6, 3 and 2 square metres, of 22 in all.
  const std::vector<SurfacePoint> points = sample_surface(make_box({3, 2, 1}), 2200);
  ASSERT_EQ(points.size(), 2200U);
  Eigen::Vector3d by_axis = Eigen::Vector3d::Zero();
  for (const SurfacePoint& point : points) by_axis += point.normal_L.cwiseAbs();
  EXPECT_NEAR(by_axis.z(), 1200, 4);
  EXPECT_NEAR(by_axis.y(), 600, 4);
  EXPECT_NEAR(by_axis.x(), 400, 4);
}

TEST(SampleSurface, PointsLieOnTheSurfaceAndAllOverIt) {
  const std::vector<SurfacePoint> points = sample_surface(make_box({2, 2, 2}), 2400);
  Eigen::Matrix2i quarters_of_top = Eigen::Matrix2i::Zero();
  for (const SurfacePoint& point : points) {
    EXPECT_NEAR(point.p_L_m.cwiseAbs().maxCoeff(), 1, 1e-9);
    EXPECT_NEAR(std::abs(point.normal_L.dot(point.p_L_m)), 1, 1e-9);
    EXPECT_NEAR(point.normal_L.norm(), 1, 1e-9);
    if (point.p_L_m.z() > 1 - 1e-9) ++quarters_of_top(point.p_L_m.x() > 0, point.p_L_m.y() > 0);
  }
  EXPECT_GT(quarters_of_top.minCoeff(), 92);
  EXPECT_LT(quarters_of_top.maxCoeff(), 108);
}

TEST(SampleSurface, TrianglesInTurnDoNotBiasIt) {
  // Every other triangle stands on the other plane: a fixed step would take one of them alone.
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 800; ++i) {
    const auto x = static_cast<float>(i / 2);
    const float z = i % 2 == 0 ? 0.0F : 1.0F;
    mesh.vertices_m.insert(mesh.vertices_m.end(), {{x, 0, z}, {x + 1, 0, z}, {x, 1, z}});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  double upper = 0;
  for (const SurfacePoint& point : sample_surface(mesh, 400)) upper += point.p_L_m.z();
  EXPECT_NEAR(upper, 200, 20);
}

TEST(SampleUnitBall, FillsTheBallEvenly) {
  const std::vector<Eigen::Vector3d> points = sample_unit_ball(kSamplePoints);
  ASSERT_EQ(points.size(), static_cast<std::size_t>(kSamplePoints));
  int octants[8] = {};
  int inner_half = 0;
  for (const Eigen::Vector3d& p : points) {
    EXPECT_LE(p.norm(), 1 + 1e-12);
    ++octants[(p.x() > 0) + 2 * (p.y() > 0) + 4 * (p.z() > 0)];
    inner_half += p.norm() < std::cbrt(0.5);
  }
  for (const int count : octants) EXPECT_NEAR(count, kSamplePoints / 8, 8);
  EXPECT_NEAR(inner_half, kSamplePoints / 2, 8);
}

TEST(SamplePoints, AreThoseOfTheEvaluatedLinksInTheOrderOfTheirIds) {
  RobotModel model =
      robot_of({make_sphere(1), make_box({1, 1, 1}), make_sphere(2), make_sphere(3)});
  set_last_role(model, LinkRole::environment);
  const SamplePoints points = sample_points(model);
  ASSERT_EQ(points.surface.size(), 3U);
  EXPECT_NEAR(points.surface[2].front().p_L_m.norm(), 2, 0.02);
  EXPECT_EQ(points.surface[1].size(), static_cast<std::size_t>(kSamplePoints));
}

}  // namespace
}  // namespace berth
