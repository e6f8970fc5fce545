#include "berth/sensor/holes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

#include "tests/sensor/images.hpp"
#include "tests/support/same_bits.hpp"

namespace berth {
namespace {

RobotImage no_robot(const DepthImage& size) {
  return {DepthImage(size.width(), size.height(), kNoDepth),
          Image<LinkId>(size.width(), size.height(), kNoLink)};
}

ObstacleImage filled(const DepthImage& depth_m, HolePolicy policy, const RobotImage& robot) {
  ObstacleImage image = kept_image(depth_m);
  HoleWorkspace workspace;
  fill_holes(policy, robot, workspace, image);
  return image;
}

/// Two readings with holes between them and around.
DepthImage two_readings() {
  DepthImage depth_m(9, 3, kNoDepth);
  depth_m(0, 1) = 2.0F;
  depth_m(4, 1) = 1.0F;
  return depth_m;
}

TEST(Holes, FreeLeavesThem) {
  const DepthImage depth_m = two_readings();
  const ObstacleImage image = filled(depth_m, HolePolicy::free, no_robot(depth_m));
  EXPECT_TRUE(same_bits(image.depth_m, depth_m));
  EXPECT_EQ(image.fate(2, 1), PixelFate::no_reading);
}

TEST(Holes, ObstacleIsRightBeforeTheCamera) {
  const DepthImage depth_m = two_readings();
  const ObstacleImage image = filled(depth_m, HolePolicy::obstacle, no_robot(depth_m));
  EXPECT_EQ(image.depth_m(2, 1), kHoleDepth_m);
  EXPECT_EQ(image.fate(2, 1), PixelFate::hole);
  EXPECT_EQ(image.depth_m(4, 1), 1.0F);
  EXPECT_EQ(image.fate(4, 1), PixelFate::obstacle);
}

TEST(Holes, NearestNeighbourIsThatInTheImageAndTheNearerOneOfTwo) {
  const DepthImage depth_m = two_readings();
  const ObstacleImage image = filled(depth_m, HolePolicy::nearest_neighbour, no_robot(depth_m));
  EXPECT_EQ(image.depth_m(1, 0), 2.0F);
  EXPECT_EQ(image.depth_m(2, 1), 1.0F);  // as far from both
  EXPECT_EQ(image.depth_m(8, 2), 1.0F);
  EXPECT_EQ(image.fate(8, 2), PixelFate::hole);
}

TEST(Holes, WhatTheModelCoversIsNone) {
  const DepthImage depth_m = two_readings();
  RobotImage robot = no_robot(depth_m);
  robot.link_id(2, 1) = 1;
  robot.link_id(3, 1) = kEnvironmentLink;
  for (const HolePolicy policy : {HolePolicy::obstacle, HolePolicy::nearest_neighbour}) {
    const ObstacleImage image = filled(depth_m, policy, robot);
    EXPECT_EQ(image.fate(2, 1), PixelFate::no_reading);
    EXPECT_EQ(image.fate(3, 1), PixelFate::no_reading);
    EXPECT_EQ(image.fate(1, 1), PixelFate::hole);
  }
}

TEST(Holes, TheRobotsOwnReadingsAreNobodysNeighbour) {
  const DepthImage depth_m = two_readings();
  ObstacleImage image = kept_image(depth_m);
  image.fate(4, 1) = PixelFate::robot;
  image.depth_m(4, 1) = kNoDepth;
  HoleWorkspace workspace;
  fill_holes(HolePolicy::nearest_neighbour, no_robot(depth_m), workspace, image);
  EXPECT_EQ(image.depth_m(5, 1), 2.0F);
  EXPECT_EQ(image.fate(4, 1), PixelFate::robot);
  EXPECT_TRUE(std::isnan(image.depth_m(4, 1)));
}

TEST(Holes, AnImageWithoutAnyReadingStaysEmpty) {
  const DepthImage depth_m(5, 4, kNoDepth);
  const ObstacleImage image = filled(depth_m, HolePolicy::nearest_neighbour, no_robot(depth_m));
  EXPECT_EQ(image.fate(2, 2), PixelFate::no_reading);
}

/// By trying all pixels.
float plain_nearest_m(const DepthImage& depth_m, int u, int v) {
  std::tuple<int, float> least{std::numeric_limits<int>::max(), kNoDepth};
  for (int y = 0; y < depth_m.height(); ++y) {
    for (int x = 0; x < depth_m.width(); ++x) {
      if (std::isnan(depth_m(x, y))) continue;
      const int squared_px = (x - u) * (x - u) + (y - v) * (y - v);
      if (std::get<0>(least) == std::numeric_limits<int>::max() ||
          std::tuple(squared_px, depth_m(x, y)) < least)
        least = {squared_px, depth_m(x, y)};
    }
  }
  return std::get<1>(least);
}

TEST(NearestPixel, AgreesWithItsDefinitionOnPatchyImages) {
  testing::Random random(3);
  NearestPixelWorkspace workspace;
  DepthImage nearest_m;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    DepthImage depth_m = patchy_image(random);
    // Mostly empty in every second image, where whole columns have no depth.
    for (float& z : depth_m.pixels()) {
      if (i % 2 == 0 && random.chance(0.95)) z = kNoDepth;
    }
    find_nearest_depth(depth_m, workspace, nearest_m);
    for (int v = 0; v < depth_m.height(); ++v) {
      for (int u = 0; u < depth_m.width(); ++u) {
        const float expected = plain_nearest_m(depth_m, u, v);
        if (std::isnan(expected)) {
          ASSERT_TRUE(std::isnan(nearest_m(u, v)));
        } else {
          ASSERT_EQ(nearest_m(u, v), expected) << u << ", " << v;
        }
      }
    }
  }
}

}  // namespace
}  // namespace berth
