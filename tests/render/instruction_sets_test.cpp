// Every instruction set that this machine has computes the same bits.
#include <gtest/gtest.h>

#include "berth/render/robot_renderer.hpp"
#include "tests/render/crowded_robot.hpp"
#include "tests/support/only_target.hpp"
#include "tests/support/same_bits.hpp"

namespace berth {
namespace {

const Camera kOddCamera{203, 157, 180, 175, 99.4, 80.1};

TEST(InstructionSets, GiveTheSameRobotImages) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const CrowdedRobot robot(seed);
    RobotRenderer renderer(build_link_meshes(robot.model), kOddCamera);
    RobotImage best;
    renderer.render(robot.pose, Pose::Identity(), best);
    on_every_target([&](const char* target) {
      SCOPED_TRACE(target);
      RobotImage image;
      renderer.render(robot.pose, Pose::Identity(), image);
      EXPECT_TRUE(same_bits(image, best));
    });
  }
}

}  // namespace
}  // namespace berth
