// A program of its own, because allocation_count replaces the global operator new.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "berth/sensor/sensor_rules.hpp"
#include "tests/self_filter/random_scene.hpp"
#include "tests/support/allocation_count.hpp"

namespace berth {
namespace {

TEST(SteadyState, TheSensorRulesAllocateNothingOnceTheyHaveSeenTheImages) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  SensorSettings settings;
  settings.speckle_px = 8;
  settings.background_frames = 2;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const RandomScene scene = random_scene(seed);
    SelfFilterWorkspace workspace;
    SensorWorkspace sensor;
    Background background;
    ObstacleImage image;
    const auto observe = [&] {
      self_filter(scene.camera, scene.sensor_depth_m, scene.robot, scene.settings, workspace,
                  image);
      background.learn(scene.camera, scene.sensor_depth_m, scene.robot, image.fate, settings);
      apply_sensor_rules(scene.camera, scene.sensor_depth_m, scene.robot,
                         {.background = &background, .always_reads = true}, settings, sensor,
                         image);
    };
    for (int frame = 0; frame < 3; ++frame) observe();
    const std::size_t before = allocation_count();
    for (int frame = 0; frame < 3; ++frame) observe();
    EXPECT_EQ(allocation_count(), before) << seed;
    EXPECT_GT(before, 0U);
  }
}

}  // namespace
}  // namespace berth
