// What a user sees of a robot that is not where it should be.
#include <gtest/gtest.h>

#include "tests/apps/refusal.hpp"

namespace berth {
namespace {

TEST(CommandImplausible, AWrongScaleIsRefusedAndNamed) {
  CommandScene scene;
  scene.lines.more_camera = "depth_scale: 0.01";
  const std::vector<std::string> told = {"scene.yaml", "camera front", "0 % lie at its surface",
                                         "expected", "depth_scale is 0.001"};
  expect_refused(scene, {"run", "scene.yaml", "--out", "result.txt"}, told);
  expect_refused(scene, {"filter", "scene.yaml", "--out", "filtered"}, told);
}

TEST(CommandImplausible, OneOfTwoCamerasIsSaidAndTheOtherAnswers) {
  CommandScene scene;
  scene.lines.more_cameras =
      "  - name: wrong\n    info: camera_info.yaml\n    pose: " + scene.lines.pose +
      "\n    depth: " + scene.lines.depth + "\n    depth_scale: 0.0001\n";
  const Outcome outcome = scene.berth({"run", "scene.yaml"});
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("camera wrong: the robot is not where it should be"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("depth_scale is 0.001"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("camera front: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("wrong (implausible"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace berth
