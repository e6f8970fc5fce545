// What was dropped for its size and place.
#include "berth/visibility/rejected.hpp"

#include <gtest/gtest.h>

#include "tests/visibility/dropped_scene.hpp"

namespace berth::testing {
namespace {

TEST(Rejected, FlyingPatchesSpeckleAndWhatIsSoftHaveTheirReadingAndNothingElseHasOne) {
  DroppedScene scene = dropped_scene(3);
  RejectedImage rejected;
  find_rejected(scene.sensor_depth_m, scene.obstacles, rejected);
  std::vector<Pixel> expected;
  for (int v = 0; v < kDroppedHeight_px; ++v) {
    for (int u = 0; u < kDroppedWidth_px; ++u) {
      const PixelFate fate = scene.obstacles.fate(u, v);
      if (fate == PixelFate::flying_patch || fate == PixelFate::speckle ||
          fate == PixelFate::soft) {
        ASSERT_EQ(rejected.depth_m(u, v), scene.sensor_depth_m(u, v));
        expected.push_back({u, v});
      } else {
        ASSERT_TRUE(std::isnan(rejected.depth_m(u, v))) << u << " " << v;
      }
    }
  }
  EXPECT_EQ(rejected.pixels, expected);
}

TEST(Rejected, NothingStaysFromTheImageBefore) {
  DroppedScene scene = dropped_scene(3);
  RejectedImage rejected;
  find_rejected(scene.sensor_depth_m, scene.obstacles, rejected);
  ASSERT_FALSE(rejected.pixels.empty());
  scene.obstacles.count = {};
  scene.obstacles.fate.resize(kDroppedWidth_px, kDroppedHeight_px, PixelFate::obstacle);
  find_rejected(scene.sensor_depth_m, scene.obstacles, rejected);
  EXPECT_TRUE(rejected.pixels.empty());
  for (const float depth_m : rejected.depth_m.pixels()) ASSERT_TRUE(std::isnan(depth_m));
}

TEST(Rejected, ANewSizeIsTaken) {
  DroppedScene scene = dropped_scene(3);
  RejectedImage rejected;
  find_rejected(scene.sensor_depth_m, scene.obstacles, rejected);
  clear_rejected(10, 20, rejected);
  EXPECT_TRUE(rejected.pixels.empty());
  EXPECT_EQ(rejected.depth_m.width(), 10);
  EXPECT_EQ(rejected.depth_m.height(), 20);
}

}  // namespace
}  // namespace berth::testing
