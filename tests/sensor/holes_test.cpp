#include "berth/sensor/holes.hpp"

#include <gtest/gtest.h>

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
  fill_holes(policy, robot, image);
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

TEST(Holes, WhatTheModelCoversIsNone) {
  const DepthImage depth_m = two_readings();
  RobotImage robot = no_robot(depth_m);
  robot.link_id(2, 1) = 1;
  robot.link_id(3, 1) = kEnvironmentLink;
  const ObstacleImage image = filled(depth_m, HolePolicy::obstacle, robot);
  EXPECT_EQ(image.fate(2, 1), PixelFate::no_reading);
  EXPECT_EQ(image.fate(3, 1), PixelFate::no_reading);
  EXPECT_EQ(image.fate(1, 1), PixelFate::hole);
}

}  // namespace
}  // namespace berth
