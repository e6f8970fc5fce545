// A program of its own, because allocation_count replaces the global operator new.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "berth/render/robot_renderer.hpp"
#include "tests/render/crowded_robot.hpp"
#include "tests/support/allocation_count.hpp"

namespace berth {
namespace {

const Camera kCamera{203, 157, 180, 175, 99.4, 80.1};

TEST(SteadyState, RenderAllocatesNothingOnceItHasRun) {
  const CrowdedRobot robot(1);
  RobotPose moved = robot.pose;
  for (Pose& X_BL : moved.X_BL) X_BL.translation().x() += 0.5;
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    RobotRenderer renderer(build_link_meshes(robot.model), kCamera);
    RobotImage image;
    const auto render_both = [&] {
      renderer.render(robot.pose, Pose::Identity(), image);
      renderer.render(moved, Pose::Identity(), image);
    };
    render_both();
    const std::size_t before = allocation_count();
    render_both();
    EXPECT_EQ(allocation_count(), before) << threads;
    EXPECT_GT(before, 0U);
  }
}

}  // namespace
}  // namespace berth
