// The whole filter against its plain definition on random scenes, however many threads there are
// and whatever instructions the machine has.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "berth/self_filter/self_filter.hpp"
#include "tests/self_filter/plain_definition.hpp"
#include "tests/self_filter/random_scene.hpp"
#include "tests/support/only_target.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/thinned.hpp"

namespace berth {
namespace {

void filter_scene(const RandomScene& scene, SelfFilterWorkspace& workspace, ObstacleImage& out) {
  self_filter(scene.camera, scene.sensor_depth_m, scene.robot, scene.settings, workspace, out);
}

void expect_same(const ObstacleImage& found, const ObstacleImage& expected) {
  ASSERT_EQ(found.fate.pixels().size(), expected.fate.pixels().size());
  for (int v = 0; v < expected.fate.height(); ++v) {
    for (int u = 0; u < expected.fate.width(); ++u)
      ASSERT_EQ(found.fate(u, v), expected.fate(u, v)) << "pixel " << u << ", " << v;
  }
  EXPECT_EQ(found.count, expected.count);
  EXPECT_TRUE(same_bits(found.depth_m, expected.depth_m));
}

/// One workspace for scenes of all sizes, so that nothing of a former one may show.
void expect_definition(std::uint32_t first_seed, std::uint32_t end_seed) {
  SelfFilterWorkspace workspace;
  ObstacleImage out;
  for (std::uint32_t seed = first_seed; seed < end_seed; ++seed) {
    SCOPED_TRACE(seed);
    const RandomScene scene = random_scene(seed);
    filter_scene(scene, workspace, out);
    expect_same(out,
                plain_self_filter(scene.camera, scene.sensor_depth_m, scene.robot, scene.settings));
    if (::testing::Test::HasFatalFailure()) return;
  }
}

TEST(Definition, HoldsWithOneThread) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  expect_definition(0, thinned(200));
}

TEST(Definition, HoldsWithTwoThreads) {
  const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
  expect_definition(200, 200 + thinned(200));
}

TEST(Definition, HoldsWithEveryInstructionSet) {
  on_every_target([](const char* target) {
    SCOPED_TRACE(target);
    expect_definition(400, 400 + thinned(40));
  });
}

/// The rule by itself: what the filter without it keeps and the region does not show.
TEST(Definition, OfTheRegionHolds) {
  SelfFilterWorkspace workspace;
  ObstacleImage out;
  std::int64_t ignored = 0;
  std::int64_t kept = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    RandomScene scene = random_scene(seed);
    ObstacleImage expected;
    filter_scene(scene, workspace, expected);
    const RobotImage region =
        sim::random_images(seed + 1000, scene.camera.width_px, scene.camera.height_px, 3).robot;
    for (int v = 0; v < scene.camera.height_px; ++v) {
      for (int u = 0; u < scene.camera.width_px; ++u) {
        if (expected.fate(u, v) != PixelFate::obstacle || region.link_id(u, v) != kNoLink) continue;
        expected.fate(u, v) = PixelFate::outside_region;
        expected.depth_m(u, v) = kNoDepth;
        --expected.count[static_cast<std::size_t>(PixelFate::obstacle)];
        ++expected.count[static_cast<std::size_t>(PixelFate::outside_region)];
      }
    }
    scene.settings.robot_region_scale = 6;
    self_filter(scene.camera, scene.sensor_depth_m, scene.robot, region, scene.settings, workspace,
                out);
    expect_same(out, expected);
    ignored += out.count_of(PixelFate::outside_region);
    kept += out.count_of(PixelFate::obstacle);
  }
  EXPECT_GT(ignored, 10000);
  EXPECT_GT(kept, 10000);
}

TEST(Definition, OfTheRegionIsRefusedWithoutOneAndTheOtherWayRound) {
  RandomScene scene = random_scene(1);
  SelfFilterWorkspace workspace;
  ObstacleImage out;
  EXPECT_THROW(self_filter(scene.camera, scene.sensor_depth_m, scene.robot, scene.robot,
                           scene.settings, workspace, out),
               std::invalid_argument);
  scene.settings.robot_region_scale = 6;
  EXPECT_THROW(filter_scene(scene, workspace, out), std::invalid_argument);
}

TEST(Definition, IsTriedOnScenesWhereEveryRuleAppliesOften) {
  std::array<int, kSelfFilterFateCount> scenes{};
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const RandomScene scene = random_scene(seed);
    SelfFilterWorkspace workspace;
    ObstacleImage out;
    filter_scene(scene, workspace, out);
    for (int fate = 0; fate < kSelfFilterFateCount; ++fate) scenes[fate] += out.count[fate] > 0;
  }
  // The region has a test of its own.
  EXPECT_GE(*std::min_element(scenes.begin(), std::prev(scenes.end())), 30);
}

}  // namespace
}  // namespace berth
