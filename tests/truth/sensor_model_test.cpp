#include "sim/sensor_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace berth::sim {
namespace {

constexpr int kWidth = 200;
constexpr int kHeight = 100;

DepthImage flat(float depth_m) { return DepthImage(kWidth, kHeight, depth_m); }

/// 1 m on the left of `edge_u`, 2 m from there on.
DepthImage step_at(int edge_u) {
  DepthImage depth_m = flat(2);
  for (int v = 0; v < kHeight; ++v) std::fill_n(depth_m.row(v), edge_u, 1.F);
  return depth_m;
}

double mean(const DepthImage& depth_m) {
  double sum = 0;
  for (const float z : depth_m.pixels()) sum += z;
  return sum / static_cast<double>(depth_m.pixels().size());
}

double deviation(const DepthImage& depth_m) {
  const double middle = mean(depth_m);
  double sum = 0;
  for (const float z : depth_m.pixels()) sum += (z - middle) * (z - middle);
  return std::sqrt(sum / static_cast<double>(depth_m.pixels().size()));
}

std::int64_t count_lost(const DepthImage& depth_m) {
  return std::count_if(depth_m.pixels().begin(), depth_m.pixels().end(),
                       [](float z) { return std::isnan(z); });
}

TEST(SensorModel, QuantisationStepsGrowWithTheSquareOfTheDepth) {
  for (const double z_m : {1.0, 2.0, 3.0}) {
    const double step_m = 0.003 * z_m * z_m;
    DepthImage depth_m(1000, 1, kNoDepth);
    for (int u = 1; u < 1000; ++u) {
      depth_m(u, 0) = static_cast<float>(z_m + step_m * 10 * u / 1000);
    }
    const DepthImage before_m = depth_m;
    quantise(0.003, depth_m);
    int steps = 0;
    for (int u = 1; u < 1000; ++u) {
      EXPECT_LE(std::abs(depth_m(u, 0) - before_m(u, 0)), 0.6 * step_m);
      if (u > 1 && depth_m(u, 0) != depth_m(u - 1, 0)) ++steps;
    }
    EXPECT_NEAR(steps, 10, 1) << z_m;
    EXPECT_TRUE(std::isnan(depth_m(0, 0)));
  }
}

TEST(SensorModel, NoiseGrowsWithTheSquareOfTheDepth) {
  for (const float z_m : {1.F, 3.F}) {
    DepthImage depth_m = flat(z_m);
    add_noise(0.002, 5, depth_m);
    EXPECT_NEAR(mean(depth_m), z_m, 1e-4 * z_m * z_m);
    EXPECT_NEAR(deviation(depth_m), 0.002 * z_m * z_m, 1e-4 * z_m * z_m);
  }
}

TEST(SensorModel, DropoutsHaveTheirShare) {
  DepthImage depth_m = flat(1);
  drop_out(0.2, 5, depth_m);
  EXPECT_NEAR(static_cast<double>(count_lost(depth_m)), 0.2 * kWidth * kHeight, 300);
}

TEST(SensorModel, MixedPixelsLieBetweenBothSidesOfAnEdgeAndNowhereElse) {
  DepthImage depth_m = step_at(50);
  mix_edge_pixels(0.5, 5, depth_m);
  int mixed = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      if (depth_m(u, v) == step_at(50)(u, v)) continue;
      EXPECT_EQ(u, 50);
      EXPECT_GE(depth_m(u, v), 1);
      EXPECT_LE(depth_m(u, v), 2);
      ++mixed;
    }
  }
  EXPECT_NEAR(mixed, kHeight / 2, 20);
}

TEST(SensorModel, DarkOutlinesHaveTheirWidthOnTheFarSide) {
  for (const int width_px : {1, 3}) {
    DepthImage depth_m = step_at(50);
    darken_outlines(width_px, depth_m);
    for (int u = 0; u < kWidth; ++u) {
      EXPECT_EQ(std::isnan(depth_m(u, 40)), u >= 50 && u < 50 + width_px) << u;
    }
  }
}

TEST(SensorModel, EveryEffectKeepsPixelsWithoutReadingAndDependsOnItsSeed) {
  const auto spoil = [](std::uint32_t seed) {
    DepthImage depth_m = step_at(50);
    depth_m(10, 10) = kNoDepth;
    quantise(0.003, depth_m);
    add_noise(0.002, seed, depth_m);
    drop_out(0.1, seed, depth_m);
    mix_edge_pixels(0.3, seed, depth_m);
    darken_outlines(2, depth_m);
    EXPECT_TRUE(std::isnan(depth_m(10, 10)));
    return count_lost(depth_m);
  };
  EXPECT_EQ(spoil(1), spoil(1));
  EXPECT_NE(spoil(1), spoil(2));
}

TEST(SensorModel, AMiscalibratedCameraStandsAndLooksElsewhereByWhatIsAskedFor) {
  Pose X_BC = Pose::Identity();
  X_BC.translation() = Eigen::Vector3d(1, 2, 3);
  const Pose X = miscalibrated(X_BC, 0.02, 0.01, 3);
  EXPECT_NEAR((X.translation() - X_BC.translation()).norm(), 0.02, 1e-12);
  EXPECT_NEAR(Eigen::AngleAxisd(X_BC.linear().transpose() * X.linear()).angle(), 0.01, 1e-9);
  EXPECT_TRUE(miscalibrated(X_BC, 0, 0, 3).isApprox(X_BC));
  EXPECT_FALSE(X.isApprox(miscalibrated(X_BC, 0.02, 0.01, 4)));
}

TEST(SensorModel, DelayedJointsLagByAtMostTheirSpeedAndKeepTheirLimits) {
  RobotModel model;
  model.joints = {{"a", JointType::revolute, -1, 1},
                  {"b", JointType::prismatic, 0, 1},
                  {"c", JointType::continuous}};
  const JointState now{1.5, {0.5, 0.5, 7}};
  const JointState before = delayed(model, now, 0.05, 2, 9);
  EXPECT_DOUBLE_EQ(before.stamp_s, 1.45);
  EXPECT_LE(std::abs(before.position[0] - 0.5), 0.1);
  EXPECT_LE(std::abs(before.position[1] - 0.5), 0.01);
  EXPECT_LE(std::abs(before.position[2] - 7), 0.1);
  EXPECT_NE(before.position[0], now.position[0]);
  EXPECT_EQ(delayed(model, now, 0, 2, 9).position, now.position);
  EXPECT_LE(delayed(model, {0, {1, 1, 0}}, 10, 2, 9).position[0], 1);
}

}  // namespace
}  // namespace berth::sim
