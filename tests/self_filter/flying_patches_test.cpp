// Which pieces beside the robot are its own leftovers, and which are not.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/self_filter/flat_scene.hpp"

namespace berth {
namespace {

constexpr PixelRect kLink{20, 20, 30, 40};
// At 1 m a pixel is 10 mm wide, so that these flying pixels end 60 mm beside the link.
constexpr PixelRect kFlyingPixels{30, 25, 36, 35};

/// They end in a hole, as those of cameras do.
FlatScene scene_with_flying_pixels(float flying_depth_m) {
  FlatScene scene;
  scene.add_link(1, kLink, 1.0F);
  scene.see({kLink.u_begin, kLink.v_begin, 39, kLink.v_end}, kNoDepth);
  scene.see(kLink, 1.0F);
  scene.see(kFlyingPixels, flying_depth_m);
  return scene;
}

SelfFilterSettings flying_patch_rule() {
  SelfFilterSettings settings = no_rules();
  settings.tolerance_m = 0.04;
  settings.padding_m = 0.02;
  settings.flying_patch_radius_m = 0.08;
  return settings;
}

TEST(FlyingPatches, AFlyingPatchBesideTheRobotIsDropped) {
  const ObstacleImage out = filter(scene_with_flying_pixels(1.0F), flying_patch_rule());
  EXPECT_EQ(out.fate(34, 30), PixelFate::flying_patch);
  EXPECT_EQ(out.count_of(PixelFate::flying_patch),
            4 * 10);  // the padding took 2 px of 6
}

TEST(FlyingPatches, AThingThatEndsInAStepIsKept) {
  FlatScene scene;
  scene.add_link(1, kLink, 1.0F);
  scene.see(kLink, 1.0F);
  scene.see(kFlyingPixels, 1.0F);
  const ObstacleImage out = filter(scene, flying_patch_rule());
  EXPECT_EQ(out.count_of(PixelFate::flying_patch), 0);
  EXPECT_EQ(out.fate(34, 30), PixelFate::obstacle);
}

/// Of the 28 pixels of the flying pixels' free rim, `rows` rows of three end in a step.
PixelFate fate_with_sharp_rows(int rows) {
  FlatScene scene = scene_with_flying_pixels(1.0F);
  scene.see({36, 25, 39, 25 + rows}, FlatScene::kWall_m);
  return filter(scene, flying_patch_rule()).fate(34, 30);
}

TEST(FlyingPatches, AThingNeedsTenSharpPixelsOfItsRim) {
  EXPECT_EQ(fate_with_sharp_rows(6), PixelFate::flying_patch);
  EXPECT_EQ(fate_with_sharp_rows(10), PixelFate::obstacle);
}

TEST(FlyingPatches, AStepOfLessThanThreeCentimetresIsNotSharp) {
  FlatScene scene;
  scene.robot.depth_m = DepthImage(kSide_px, kSide_px, kNoDepth);
  scene.add_link(1, kLink, 1.0F);
  scene.see({0, 0, kSide_px, kSide_px}, kNoDepth);
  scene.see(kLink, 1.0F);
  scene.see(kFlyingPixels, 1.0F);
  scene.see({36, 25, 37, 35}, 1.04F);
  EXPECT_EQ(filter(scene, flying_patch_rule()).fate(34, 30), PixelFate::obstacle);
  scene.see({36, 25, 37, 35}, 0.96F);
  EXPECT_EQ(filter(scene, flying_patch_rule()).fate(34, 30), PixelFate::flying_patch);
}

TEST(FlyingPatches, ACrumbIsSpeckle) {
  FlatScene scene = scene_with_flying_pixels(1.0F);
  scene.see({32, 25, 36, 35}, kNoDepth);
  scene.see({32, 30, 33, 31}, 0.99F);  // 0.98 cm^2 beside the padding
  const ObstacleImage out = filter(scene, flying_patch_rule());
  EXPECT_EQ(out.fate(32, 30), PixelFate::speckle);
  EXPECT_EQ(out.count_of(PixelFate::speckle), 1);
  EXPECT_TRUE(std::isnan(out.depth_m(32, 30)));
  scene.see({32, 30, 34, 31}, 1.0F);
  EXPECT_EQ(filter(scene, flying_patch_rule()).fate(32, 30), PixelFate::flying_patch);
}

TEST(FlyingPatches, RadiusZeroTurnsTheRuleOff) {
  SelfFilterSettings settings = flying_patch_rule();
  settings.flying_patch_radius_m = 0;
  EXPECT_EQ(filter(scene_with_flying_pixels(1.0F), settings).fate(34, 30), PixelFate::obstacle);
}

TEST(FlyingPatches, APieceThatReachesFartherThanTheRadiusIsKeptWhole) {
  FlatScene scene = scene_with_flying_pixels(1.0F);
  scene.see({36, 29, 50, 31}, 1.0F);  // an arm that reaches in
  const ObstacleImage out = filter(scene, flying_patch_rule());
  EXPECT_EQ(out.count_of(PixelFate::flying_patch), 0);
  EXPECT_EQ(out.fate(34, 26), PixelFate::obstacle);
}

TEST(FlyingPatches, AStepInDepthCutsThePiece) {
  FlatScene scene = scene_with_flying_pixels(1.0F);
  scene.see({36, 29, 50, 31}, 1.04F);
  EXPECT_EQ(filter(scene, flying_patch_rule()).fate(34, 30), PixelFate::flying_patch);
  scene.see({36, 29, 50, 31}, 1.02F);
  EXPECT_EQ(filter(scene, flying_patch_rule()).fate(34, 30), PixelFate::obstacle);
}

/// Flying pixels that get deeper by so much from column to column.
FlatScene scene_with_slope(float step_m) {
  FlatScene scene = scene_with_flying_pixels(1.0F);
  for (int u = kFlyingPixels.u_begin; u < kFlyingPixels.u_end; ++u) {
    const float depth_m = 1.0F + step_m * static_cast<float>(u - kFlyingPixels.u_begin + 1);
    scene.see({u, kFlyingPixels.v_begin, u + 1, kFlyingPixels.v_end}, depth_m);
  }
  return scene;
}

TEST(FlyingPatches, AFlyingPatchThatSlopesAwayIsDroppedUpToThePaddingDepth) {
  SelfFilterSettings settings = flying_patch_rule();
  settings.padding_depth_m = 0.05;
  EXPECT_EQ(filter(scene_with_slope(0.005F), settings).fate(32, 30), PixelFate::flying_patch);
  EXPECT_EQ(filter(scene_with_slope(0.015F), settings).fate(32, 30), PixelFate::obstacle);
}

TEST(FlyingPatches, ARimThatShowsBesideTheRobotAStepBehindOrBeforeItIsKept) {
  for (const float depth_m : {0.9F, 0.95F, 0.96F, 1.04F, 1.05F}) {
    const ObstacleImage out = filter(scene_with_flying_pixels(depth_m), flying_patch_rule());
    EXPECT_EQ(out.count_of(PixelFate::flying_patch), 0) << depth_m;
    EXPECT_EQ(out.fate(34, 30), PixelFate::obstacle) << depth_m;
  }
}

TEST(FlyingPatches, APieceThatFloatsBesideTheRobotIsKept) {
  FlatScene scene = scene_with_flying_pixels(1.0F);
  scene.see({30, 20, 31, 40}, kNoDepth);
  EXPECT_EQ(filter(scene, flying_patch_rule()).fate(34, 30), PixelFate::obstacle);
}

TEST(FlyingPatches, ReadingsBehindTheModelAreNotTheRobotsOwn) {
  const PixelRect rim{30, 25, 34, 35};
  const auto fate_at = [&](float depth_m) {
    FlatScene scene;
    scene.add_link(1, kLink, 1.0F);
    scene.see({20, 20, 37, 40}, kNoDepth);
    scene.see(kLink, depth_m);
    scene.see(rim, depth_m);
    return filter(scene, flying_patch_rule()).fate(33, 30);
  };
  EXPECT_EQ(fate_at(1.035F), PixelFate::flying_patch);
  EXPECT_EQ(fate_at(1.045F), PixelFate::obstacle);
}

TEST(FlyingPatches, WhatStandsInFrontOfTheRobotIsKeptHoweverSmall) {
  FlatScene scene = scene_with_flying_pixels(1.0F);
  scene.see({24, 28, 27, 31}, 0.94F);
  EXPECT_EQ(filter(scene, flying_patch_rule()).fate(25, 29), PixelFate::obstacle);
}

TEST(FlyingPatches, APieceThatIsJoinedToSomethingInFrontOfTheRobotIsKept) {
  FlatScene scene = scene_with_flying_pixels(0.965F);
  scene.see(kLink, 0.965F);
  EXPECT_EQ(filter(scene, flying_patch_rule()).fate(33, 29), PixelFate::flying_patch);
  scene.see({28, 28, 34, 31}, 0.95F);
  const ObstacleImage out = filter(scene, flying_patch_rule());
  EXPECT_EQ(out.fate(29, 29), PixelFate::obstacle);
  EXPECT_EQ(out.fate(33, 29), PixelFate::obstacle);
}

TEST(FlyingPatches, WhatIsBesideTheRobotAndNearerThanTheToleranceAllowsIsKept) {
  const auto flying_patches_at = [](float depth_m) {
    FlatScene scene = scene_with_flying_pixels(depth_m);
    scene.see(kLink, 0.97F);
    SelfFilterSettings settings = flying_patch_rule();
    settings.padding_m = 0;
    return filter(scene, settings).count_of(PixelFate::flying_patch);
  };
  EXPECT_EQ(flying_patches_at(0.965F), 60);
  EXPECT_EQ(flying_patches_at(0.955F), 0);
}

TEST(FlyingPatches, AFarCamerasStepsJoinTheFlyingPixels) {
  for (const float depth_m : {1.0F, 2.0F}) {
    FlatScene scene;
    scene.add_link(1, kLink, depth_m);
    scene.see({20, 20, 35, 40}, kNoDepth);
    scene.see(kLink, depth_m);
    scene.see({30, 25, 32, 35}, depth_m + 0.05F);
    SelfFilterSettings settings = flying_patch_rule();
    settings.padding_m = 0;
    settings.tolerance_m = 0.06;
    const bool is_joined = depth_m > 1.5F;  // 3 cm at 1 m, 12 cm at 2 m
    EXPECT_EQ(filter(scene, settings).count_of(PixelFate::flying_patch), is_joined ? 20 : 0);
  }
}

TEST(FlyingPatches, EnvironmentHasNoFlyingPatches) {
  FlatScene scene;
  scene.add_link(kEnvironmentLink, kLink, 1.0F);
  scene.see(kLink, 1.0F);
  scene.see(kFlyingPixels, 1.0F);
  SelfFilterSettings settings = flying_patch_rule();
  settings.padding_m = 0;
  EXPECT_EQ(filter(scene, settings).count_of(PixelFate::flying_patch), 0);
}

}  // namespace
}  // namespace berth
