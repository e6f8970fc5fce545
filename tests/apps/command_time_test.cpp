// `berth run` of a scene whose stamps and joints do not go together.
#include <gtest/gtest.h>

#include "tests/apps/command_scene.hpp"

namespace berth {
namespace {

TEST(RunTime, AFrameThatTheJointsDoNotReachHasAStatusAndNoDistance) {
  CommandScene scene;
  scene.lines.more_camera = "stamps: [-0.5, 1, 2.25]";
  const std::vector<Json> frames = scene.json({"run", "scene.yaml", "--picture", "pictures"});
  ASSERT_EQ(frames.size(), 3U);
  for (const int i : {0, 2}) {
    EXPECT_EQ(frames[i]["time"]["status"], "extrapolated_too_far");
    EXPECT_EQ(frames[i]["stamp_s"], i == 0 ? -0.5 : 2.25);
    EXPECT_EQ(frames[i]["status"], "stale");
    EXPECT_TRUE(frames[i]["nearest"].is_null());
    EXPECT_EQ(frames[i]["links"].size(), frames[1]["links"].size());
    for (const Json& link : frames[i]["links"]) {
      EXPECT_EQ(link["status"], "stale");
      EXPECT_TRUE(link["distance_m"].is_null());
      EXPECT_TRUE(link["robot_point_base_m"].is_null());
    }
  }
  EXPECT_EQ(frames[1]["time"]["status"], "ok");
  EXPECT_EQ(link_of(frames[1], "upper")["status"], "ok");
  const Outcome table = scene.berth({"run", "scene.yaml"});
  EXPECT_NE(table.out.find("frame 0, -0.500 s"), std::string::npos);
  EXPECT_NE(table.out.find("range 2 m, no answer: extrapolated_too_far"), std::string::npos);
  EXPECT_EQ(scene.berth({"filter", "scene.yaml", "--out", "filtered"}).exit_status, 0);
}

TEST(RunTime, TheScenesLimitsDecide) {
  CommandScene scene;
  scene.lines.more_camera = "stamps: [0.3, 1, 2.25]";
  // The images do not belong to these joints.
  const std::string unwatched = "\nwatch: {min_at_robot: 0}";
  scene.lines.more = unwatched;
  const auto status = [&](int frame) { return scene.run().at(frame)["time"]["status"]; };
  EXPECT_EQ(status(0), "skewed") << "0.1 s is the default";
  scene.lines.more = "time: {max_skew_s: 0.29}" + unwatched;
  EXPECT_EQ(status(0), "skewed");
  scene.lines.more = "time: {max_skew_s: 0.31}" + unwatched;
  EXPECT_EQ(status(0), "ok");
  EXPECT_EQ(status(2), "extrapolated_too_far");
}

}  // namespace
}  // namespace berth
