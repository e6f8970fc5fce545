// A program of its own, because allocation_count replaces the global operator new.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "berth/self_filter/self_filter.hpp"
#include "tests/self_filter/random_scene.hpp"
#include "tests/support/allocation_count.hpp"

namespace berth {
namespace {

TEST(SteadyState, TheSelfFilterAllocatesNothingOnceItHasSeenTheImages) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    RandomScene scene = random_scene(seed);
    SelfFilterWorkspace workspace;
    ObstacleImage out;
    SelfFilterSettings in_region = scene.settings;
    in_region.robot_region_scale = 6;
    const auto filter = [&] {
      self_filter(scene.camera, scene.sensor_depth_m, scene.robot, scene.settings, workspace, out);
      self_filter(scene.camera, scene.sensor_depth_m, scene.robot, scene.robot, in_region,
                  workspace, out);
    };
    filter();
    const std::size_t before = allocation_count();
    filter();
    EXPECT_EQ(allocation_count(), before);
    EXPECT_GT(before, 0u);
  }
}

}  // namespace
}  // namespace berth
