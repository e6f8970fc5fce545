// The definition of the whole robot's distances, on images whose answers are known.
#include "sim/whole_robot_points.hpp"

#include <gtest/gtest.h>

#include "flat_view.hpp"

namespace berth::sim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Depths are counted in 1/2048 m, and so is what is subtracted.
constexpr double kRounding_m = 2.0 / 2048;

double free_at(const PointView& view, int u, int v, const SpaceSettings& settings = {}) {
  return free_depth_m(view, settings)(u, v);
}

TEST(WholeRobotPoints, AWallIsASurfaceAndHidesWhatIsBehindIt) {
  const PointSpace space({wall_at(1)}, {.surface_thickness_m = 0.03});
  EXPECT_FALSE(space.is_obstacle({0, 0, 0.999}));
  EXPECT_TRUE(space.is_reading({0, 0, 1}));
  EXPECT_TRUE(space.is_reading({0.1, 0.1, 1.029}));
  EXPECT_FALSE(space.is_hidden({0, 0, 1.029}));
  EXPECT_FALSE(space.is_reading({0, 0, 1.031}));
  EXPECT_TRUE(space.is_hidden({0, 0, 1.031}));
  EXPECT_TRUE(space.is_hidden({0, 0, 9}));
  EXPECT_FALSE(space.is_obstacle({0, 0, -1}));
  EXPECT_FALSE(space.is_obstacle({0.52, 0, 1})) << "outside of the image";
  EXPECT_TRUE(space.is_obstacle({0.51, 0, 1})) << "in its last pixel";
}

TEST(WholeRobotPoints, AnotherCameraFreesWhatIsHiddenAndNoReading) {
  PointView left = wall_at(3, from_the_left(1));
  const PointSpace space({wall_at(1), left}, {});
  EXPECT_TRUE(space.is_reading({0, 0, 1.01}));
  EXPECT_FALSE(space.is_hidden({0, 0, 1.2})) << "seen free from the left";
  EXPECT_TRUE(space.is_hidden({0, 0, 1.6})) << "not in the left image";
  left.age_s = 0.3;
  EXPECT_TRUE(PointSpace({wall_at(1), left}, {}).is_hidden({0, 0, 1.2})) << "too old";
}

TEST(WholeRobotPoints, NoCameraFreesWhatItHidesItself) {
  const PointSpace space({wall_at(1), wall_at(1)}, {});
  EXPECT_TRUE(space.is_hidden({0, 0, 1.2}));
}

TEST(WholeRobotPoints, EachFateFreesWhatItShould) {
  const SpaceSettings settings{
      .free_space_margin_m = 0.02, .behind_robot_m = 0.3, .detection_capability_m = 0};
  for (const PixelFate fate : {PixelFate::robot, PixelFate::padding}) {
    PointView view = wall_at(1);
    for (int v = 4; v < 9; ++v) {
      for (int u = 4; u < 9; ++u) drop(view, u, v, fate);
    }
    EXPECT_NEAR(free_at(view, 6, 6, settings), 1.3, kRounding_m);
    EXPECT_NEAR(free_at(view, 4, 6, settings), 0.98, kRounding_m) << "the least of 3 x 3";
  }
  for (const PixelFate fate :
       {PixelFate::flying_patch, PixelFate::soft, PixelFate::speckle, PixelFate::outside_region}) {
    PointView view = wall_at(1);
    view.sensor_depth_m(6, 6) = 0.5F;
    drop(view, 6, 6, fate);
    EXPECT_NEAR(free_at(view, 7, 7, settings), 0.48, kRounding_m);
    EXPECT_NEAR(free_at(view, 8, 8, settings), 0.98, kRounding_m);
  }
}

TEST(WholeRobotPoints, EnvironmentFreesUpToItsBack) {
  const SpaceSettings settings{
      .free_space_margin_m = 0.02, .behind_robot_m = 0.3, .detection_capability_m = 0};
  PointView view = wall_at(1);
  for (const auto& [back_m, free_m] :
       {std::pair{0.9F, 0.98}, {1.03F, 1.03}, {2.0F, 1.3}, {kNoDepth, 0.98}}) {
    for (float& m : view.sensor_depth_m.pixels()) m = 3;
    for (float& m : view.obstacle_depth_m.pixels()) m = 3;
    view.environment_back_m = DepthImage(kFlatCamera.width_px, kFlatCamera.height_px, kNoDepth);
    view.environment_back_m(6, 6) = back_m;
    view.sensor_depth_m(6, 6) = 1;
    drop(view, 6, 6, PixelFate::environment);
    EXPECT_NEAR(free_at(view, 6, 6, settings), free_m, kRounding_m) << back_m;
  }
  view.environment_back_m = {};
  EXPECT_NEAR(free_at(view, 6, 6, settings), 0.98, kRounding_m);
}

TEST(WholeRobotPoints, ALearnedBackgroundFreesNoMoreThanTheSensorSaw) {
  const SpaceSettings settings{.detection_capability_m = 0};
  PointView view = wall_at(1);
  view.fate(6, 6) = PixelFate::background;
  view.sensor_depth_m(6, 6) = 0.5F;
  EXPECT_NEAR(free_at(view, 6, 6, settings), 0.8, kRounding_m) << "robot before the background";
  view.sensor_depth_m(6, 6) = 0.9F;
  EXPECT_NEAR(free_at(view, 6, 6, settings), 0.98, kRounding_m);
  view.sensor_depth_m(6, 6) = kNoDepth;
  EXPECT_EQ(free_at(view, 6, 6, settings), 0);
  EXPECT_EQ(free_at(view, 5, 5, settings), 0);
}

/// At 1 m a ball of 20 cm covers a disc of 4 pixels' radius.
TEST(WholeRobotPoints, WhatIsTooSmallToHideABallDoesNotHide) {
  constexpr double kMillimetre_m = 0.0011;
  const SpaceSettings off{.detection_capability_m = 0};
  const SpaceSettings settings{.detection_capability_m = 0.2};
  PointView view = wall_at(1);
  const auto make_hole = [&](int u, int v) {
    view.sensor_depth_m(u, v) = kNoDepth;
    drop(view, u, v, PixelFate::no_reading);
  };
  make_hole(10, 10);
  EXPECT_EQ(free_at(view, 10, 10, off), 0);
  EXPECT_NEAR(free_at(view, 10, 10, settings), 0.88, kMillimetre_m);
  for (int v = 0; v < 31; ++v) view.sensor_depth_m(15, v) = view.obstacle_depth_m(15, v) = 0.7F;
  EXPECT_NEAR(free_at(view, 15, 10, off), 0.68, kRounding_m);
  EXPECT_NEAR(free_at(view, 15, 10, settings), 0.88, kMillimetre_m) << "behind a cable";
  for (int v = 8; v < 24; ++v) {
    for (int u = 20; u < 36; ++u) make_hole(u, v);
  }
  EXPECT_EQ(free_at(view, 28, 16, settings), 0) << "a large hole";
  EXPECT_EQ(free_at(view, 21, 16, settings), 0) << "and what is beside its middle";
}

TEST(WholeRobotPoints, ThePolicyForMissingReadingsFreesToTheEndOfTheWorld) {
  const PointView view = flat_view([](int, int) { return NAN; });
  EXPECT_EQ(free_at(view, 9, 9), 0);
  EXPECT_EQ(free_at(view, 9, 9, {.no_reading = NoReading::free}), kInfinity);
  EXPECT_EQ(free_at(view, 0, 9, {.no_reading = NoReading::free}), 0) << "the outermost ring";
  EXPECT_EQ(free_at(view, 40, 30, {.no_reading = NoReading::free}), 0);
}

TEST(WholeRobotPoints, AgeMovesReadingsNearerAndSideways) {
  PointView view = wall_at(2);
  view.sensor_depth_m(20, 15) = view.obstacle_depth_m(20, 15) = 1;
  view.age_s = 0.1;
  const SpaceSettings settings{
      .free_space_margin_m = 0.02, .detection_capability_m = 0.04, .obstacle_speed_m_s = 1};
  // 40 px * 0.1 m / 1 m: 4 px, and one of the 3 x 3.
  EXPECT_NEAR(free_at(view, 25, 15, settings), 0.88, kRounding_m);
  EXPECT_NEAR(free_at(view, 26, 15, settings), 1.88, kRounding_m);
  view.age_s = 0.21;
  EXPECT_EQ(free_at(view, 26, 15, settings), 0);
  view.age_s = 0;
  EXPECT_NEAR(free_at(view, 21, 15, settings), 0.98, kRounding_m);
  EXPECT_NEAR(free_at(view, 22, 15, settings), 1.98, kRounding_m);
}

}  // namespace
}  // namespace berth::sim
