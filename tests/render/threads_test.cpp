// The image does not depend on how many threads draw it, nor on who of them draws what.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "berth/render/robot_renderer.hpp"
#include "tests/render/crowded_robot.hpp"
#include "tests/support/same_bits.hpp"

namespace berth {
namespace {

const Camera kThreadsCamera{203, 157, 180, 175, 99.4, 80.1};

RobotImage render_with(int threads, const CrowdedRobot& robot, RobotRenderer& renderer) {
  RobotImage image;
  tbb::task_arena(threads).execute([&] { renderer.render(robot.pose, Pose::Identity(), image); });
  return image;
}

TEST(RenderThreads, AnyNumberGivesTheSameImage) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 5);
  const CrowdedRobot robot(1);
  RobotRenderer renderer(build_link_meshes(robot.model), kThreadsCamera);
  const RobotImage alone = render_with(1, robot, renderer);
  for (int round = 0; round < 50; ++round) {
    EXPECT_TRUE(same_bits(render_with(1 + round % 5, robot, renderer), alone)) << round;
  }
}

TEST(RenderThreads, AtEqualDepthTheSmallerIdIsSeen) {
  const CrowdedRobot robot(2);
  RobotRenderer renderer(build_link_meshes(robot.model), kThreadsCamera);
  int fifth = 0;
  const RobotImage image = render_with(2, robot, renderer);
  for (const LinkId id : image.link_id.pixels()) {
    EXPECT_NE(id, 6);
    fifth += id == 5;
  }
  EXPECT_GT(fifth, 100);
}

}  // namespace
}  // namespace berth
