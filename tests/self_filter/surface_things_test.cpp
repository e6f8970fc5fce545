// What lies on the robot and on environment, and is thicker than the noise there.
#include <gtest/gtest.h>

#include "berth/self_filter/surface_things.hpp"
#include "tests/self_filter/flat_scene.hpp"

namespace berth {
namespace {

// At 1 m a pixel is 10 mm wide.
constexpr PixelRect kLink{10, 10, 50, 50};
constexpr PixelRect kHand{25, 25, 31, 29};

SelfFilterSettings surface_rule(double tolerance_m = 0.01) {
  SelfFilterSettings settings = no_rules();
  settings.tolerance_m = 0.05;
  settings.surface_tolerance_m = tolerance_m;
  return settings;
}

FlatScene scene_with_hand(LinkId link, float thickness_m) {
  FlatScene scene;
  scene.add_link(link, kLink, 1.0F);
  scene.see(kLink, 1.0F);
  scene.see(kHand, 1.0F - thickness_m);
  return scene;
}

TEST(SurfaceThings, AHandOnALinkOrOnATableIsAnObstacle) {
  for (const LinkId id : {LinkId{1}, kEnvironmentLink}) {
    const ObstacleImage out = filter(scene_with_hand(id, 0.03F), surface_rule());
    EXPECT_EQ(out.count_of(PixelFate::obstacle),
              60 * 60 - 40 * 40 + 20);  // the median takes its corners
    EXPECT_EQ(out.fate(27, 27), PixelFate::obstacle);
    EXPECT_EQ(out.depth_m(27, 27), 0.97F);
    EXPECT_NE(out.fate(24, 27), PixelFate::obstacle);
  }
}

TEST(SurfaceThings, WhatIsThinnerThanTheToleranceIsTheSurface) {
  EXPECT_EQ(filter(scene_with_hand(1, 0.009F), surface_rule()).fate(27, 27), PixelFate::robot);
  EXPECT_EQ(filter(scene_with_hand(1, 0.011F), surface_rule()).fate(27, 27), PixelFate::obstacle);
}

TEST(SurfaceThings, TheToleranceGrowsWithTheDepth) {
  const auto fate_at_two_metres = [](float thickness_m) {
    FlatScene scene;
    scene.add_link(1, kLink, 2.0F);
    scene.see(kLink, 2.0F);
    scene.see(kHand, 2.0F - thickness_m);
    return filter(scene, surface_rule()).fate(27, 27);
  };
  // 0.65 + 0.35 * 1.98^2 = 2.02
  EXPECT_EQ(fate_at_two_metres(0.019F), PixelFate::robot);
  EXPECT_EQ(fate_at_two_metres(0.022F), PixelFate::obstacle);
}

TEST(SurfaceThings, LessThanThreeSquareCentimetresIsNoise) {
  FlatScene scene = scene_with_hand(1, 0);
  scene.see({25, 25, 28, 26}, 0.97F);
  EXPECT_EQ(filter(scene, surface_rule()).fate(26, 25), PixelFate::robot);
  scene.see({25, 25, 28, 29}, 0.97F);  // the median of 3 x 3 keeps its middle columns
  EXPECT_EQ(filter(scene, surface_rule()).fate(26, 26), PixelFate::obstacle);
}

TEST(SurfaceThings, ZeroTurnsTheRuleOff) {
  EXPECT_EQ(filter(scene_with_hand(1, 0.04F), surface_rule(0)).fate(27, 27), PixelFate::robot);
}

TEST(SurfaceThings, BesideANearerPartOfTheRobotReadingsArePassedOver) {
  FlatScene scene = scene_with_hand(1, 0);
  scene.add_link(2, {10, 10, 50, 20}, 0.9F);
  scene.see({10, 10, 50, 20}, 0.9F);
  scene.see({25, 20, 35, 22}, 0.96F);  // a depth edge that the camera smooths
  EXPECT_EQ(filter(scene, surface_rule(0.016)).fate(30, 20), PixelFate::robot);
  scene.see({25, 30, 35, 32}, 0.96F);
  EXPECT_EQ(filter(scene, surface_rule(0.016)).fate(30, 30), PixelFate::obstacle);
}

TEST(SurfaceThings, ACameraThatDrawsEdgesWhereTheyAreSeesThingsNearerToThem) {
  FlatScene scene = scene_with_hand(1, 0);
  scene.add_link(2, {10, 10, 50, 20}, 0.9F);
  scene.see({10, 10, 50, 20}, 0.9F);
  scene.see({25, 20, 35, 23}, 0.96F);
  EXPECT_EQ(filter(scene, surface_rule(0.015)).fate(30, 20), PixelFate::robot);
  EXPECT_EQ(filter(scene, surface_rule(0.015)).fate(30, 21), PixelFate::obstacle);
  EXPECT_EQ(filter(scene, surface_rule(0.016)).fate(30, 21), PixelFate::robot);
}

float measured_m(const FlatScene& scene) {
  return measured_surface_tolerance(flat_camera(), scene.sensor_depth_m, scene.robot).links_m;
}

TEST(SurfaceThings, WithoutASettingTheToleranceFollowsTheCamera) {
  FlatScene scene = scene_with_hand(1, 0);
  EXPECT_EQ(measured_m(scene), float(kLeastSurfaceTolerance_m));
  for (int v = 10; v < 50; v += 4) scene.see({10, v, 50, v + 2}, 1.018F);
  EXPECT_NEAR(measured_m(scene), 0.018, 2e-4);
  for (int v = 10; v < 50; v += 4) scene.see({10, v, 50, v + 2}, 1.04F);
  EXPECT_EQ(measured_m(scene), float(kMostSurfaceTolerance_m));
}

TEST(SurfaceThings, ACameraThatReadsTooNearHasAWiderTolerance) {
  FlatScene scene = scene_with_hand(1, 0);
  scene.see(kLink, 0.991F);
  EXPECT_NEAR(measured_m(scene), 0.010, 2e-4);
  scene.see(kLink, 0.982F);
  EXPECT_NEAR(measured_m(scene), 0.018, 3e-4);
}

TEST(SurfaceThings, WhatLiesOnTheLinkDoesNotWidenItsTolerance) {
  FlatScene scene = scene_with_hand(1, 0.04F);
  EXPECT_EQ(measured_m(scene), float(kLeastSurfaceTolerance_m));
}

TEST(SurfaceThings, OfTooFewPixelsNothingIsMeasured) {
  FlatScene scene;
  scene.add_link(1, {20, 20, 35, 35}, 1.0F);
  scene.see({20, 20, 35, 35}, 1.0F);
  EXPECT_EQ(measured_m(scene), float(kMostSurfaceTolerance_m));
}

}  // namespace
}  // namespace berth
