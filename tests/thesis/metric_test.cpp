#include "thesis/metric.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/thesis/plain_definition.hpp"

namespace berth {
namespace {

// Corner convention: the principal point lies at (10, 8).
const Camera kCamera{20, 16, 10, 5, 9.5, 7.5};

float distance_m(Pixel robot, float robot_depth_m, Pixel obstacle, float obstacle_depth_m) {
  return std::sqrt(squared_distance_m2(
      metric_of(kCamera), static_cast<float>(robot.u), static_cast<float>(robot.v), robot_depth_m,
      static_cast<float>(obstacle.u), static_cast<float>(obstacle.v), obstacle_depth_m));
}

TEST(Metric, PixelsAtTheSameDepthAreAsFarApartAsTheGapBetweenThem) {
  EXPECT_FLOAT_EQ(distance_m({3, 5}, 2, {7, 5}, 2), 3 * 2.0f / 10);
  EXPECT_FLOAT_EQ(distance_m({7, 5}, 2, {3, 5}, 2), 3 * 2.0f / 10);
  EXPECT_FLOAT_EQ(distance_m({3, 5}, 2, {3, 9}, 2), 3 * 2.0f / 5);
  EXPECT_FLOAT_EQ(distance_m({3, 5}, 2, {7, 9}, 2), std::hypot(0.6f, 1.2f));
}

TEST(Metric, NeighboursAtTheSameDepthTouch) {
  for (const Pixel p : {Pixel{3, 5}, Pixel{2, 5}, Pixel{4, 5}, Pixel{3, 4}, Pixel{4, 6}}) {
    EXPECT_EQ(distance_m({3, 5}, 2, p, 2), 0);
  }
}

TEST(Metric, AnObstacleInFrontOfTheRobotCountsAtTheRobotsDepth) {
  EXPECT_EQ(distance_m({3, 5}, 2, {7, 5}, 0.5f), distance_m({3, 5}, 2, {7, 5}, 2));
  EXPECT_EQ(distance_m({3, 5}, 2, {3, 5}, 0.5f), 0);
}

TEST(Metric, BehindTheRobotInTheSameColumnTheLowerSideCounts) {
  // Side u = 4 is 6 px left of the axis, side v = 8 on it: x grows by 6 px * 1 m / 10 px.
  EXPECT_FLOAT_EQ(distance_m({4, 8}, 2, {4, 8}, 3), std::hypot(0.6f, 1.0f));
}

TEST(Metric, FacingSidesDependOnWhichPixelIsLeft) {
  // Robot side 4, obstacle side 7: x = (7 - 10) 3 / 10 - (4 - 10) 2 / 10 = 0.3.
  EXPECT_FLOAT_EQ(distance_m({3, 8}, 2, {7, 8}, 3), std::hypot(0.3f, 1.0f));
  // Robot side 7, obstacle side 4: x = (4 - 10) 3 / 10 - (7 - 10) 2 / 10 = -1.2.
  EXPECT_FLOAT_EQ(distance_m({7, 8}, 2, {3, 8}, 3), std::hypot(1.2f, 1.0f));
  // On the other side of the axis: (15 - 10) 3 / 10 - (13 - 10) 2 / 10 = 0.9.
  EXPECT_FLOAT_EQ(distance_m({12, 8}, 2, {15, 8}, 3), std::hypot(0.9f, 1.0f));
}

TEST(Metric, PointsAreBackProjectionsOfTheFacingSides) {
  const PairPoints points = pair_points(metric_of(kCamera), 3, 9, 2, 7, 5, 3);
  EXPECT_TRUE(points.robot_C_m.isApprox(Eigen::Vector3f((4 - 10) * 0.2f, (9 - 8) * 0.4f, 2)));
  EXPECT_TRUE(points.obstacle_C_m.isApprox(Eigen::Vector3f((7 - 10) * 0.3f, (6 - 8) * 0.6f, 3)));
}

TEST(Metric, MissingDepthGivesNaN) {
  for (const float nan : {kNoDepth, -kNoDepth}) {
    EXPECT_TRUE(std::isnan(distance_m({3, 5}, nan, {7, 5}, 2)));
    EXPECT_TRUE(std::isnan(distance_m({3, 5}, 2, {7, 5}, nan)));
  }
}

TEST(Metric, AgreesWithThePlainDefinitionForNearAndFarPixels) {
  std::mt19937 engine(1);
  std::uniform_int_distribution<int> u(0, 639);
  std::uniform_int_distribution<int> v(0, 479);
  std::uniform_real_distribution<float> log_depth(std::log(0.05f), std::log(60.0f));
  const Camera camera{640, 480, 525, 510, 319.5, 700};
  for (int i = 0; i < 100000; ++i) {
    const Pixel r{u(engine), v(engine)};
    const Pixel o{u(engine), v(engine)};
    const float a = std::exp(log_depth(engine));
    const float b = i % 3 == 0 ? a * 1.001f : std::exp(log_depth(engine));
    const double plain_m = testing::plain_distance_m(camera, r, a, o, b);
    const float squared_m2 =
        squared_distance_m2(metric_of(camera), static_cast<float>(r.u), static_cast<float>(r.v), a,
                            static_cast<float>(o.u), static_cast<float>(o.v), b);
    EXPECT_NEAR(std::sqrt(squared_m2), plain_m, 1e-6 * (std::max(a, b) + plain_m));
  }
}

}  // namespace
}  // namespace berth
