// What `run` tells of what the camera cannot know.
#include <gtest/gtest.h>

#include "tests/apps/command_scene.hpp"

namespace berth {
namespace {

double sum_of(const Json& shares) {
  double sum = 0;
  for (const auto& [kind, share] : shares.items()) sum += share.get<double>();
  return sum;
}

TEST(Visibility, EachLinkHasSharesThatAddUpToOne) {
  for (const Json& frame : CommandScene().run()) {
    for (const Json& link : frame["links"]) {
      const Json& visibility = link["visibility"];
      EXPECT_EQ(visibility["surface"].size(), 5U);
      EXPECT_NEAR(sum_of(visibility["surface"]), 1, 1e-6);
      if (link["status"] != "ok") continue;
      const Json& space = visibility["space"];
      EXPECT_NEAR(sum_of(space), 1, 1e-6);
      EXPECT_NEAR(visibility["space_unknown"].get<double>(),
                  space["hidden_by_robot"].get<double>() + space["no_reading"].get<double>() +
                      space["outside_image"].get<double>(),
                  1e-6);
    }
  }
}

TEST(Visibility, OfABoxBelowTheCameraFrontAndTopAreSeen) {
  CommandScene scene;
  scene.surroundings.rectangles.clear();
  scene.write_images();
  // 0.3 x 0.2 and 0.3 x 0.3 of 0.42 square metres.
  const Json base = link_of(scene.run().at(0), "base")["visibility"]["surface"];
  EXPECT_NEAR(base["seen"].get<double>(), 0.357, 0.04);
  EXPECT_EQ(base["hidden_by_obstacles"], 0);
}

TEST(Visibility, WhatStandsInFrontHidesIt) {
  CommandScene scene;
  // The same depth all over is a dead camera.
  scene.lines.more += "watch: {min_at_robot: 0}\n";
  scene.write_scene();
  scene.surroundings.rectangles = {{{0, 0, 64, 48}, 1}};
  scene.write_images();
  const Json base = link_of(scene.run().at(0), "base")["visibility"]["surface"];
  EXPECT_EQ(base["seen"], 0);
  EXPECT_GT(base["hidden_by_obstacles"], 0.1);
}

TEST(Visibility, LinkThatIsHiddenByTheRobotHasNoSpace) {
  const Json plug = link_of(CommandScene().run().at(0), "plug")["visibility"];
  EXPECT_EQ(plug["surface"]["hidden_by_robot"], 1);
  EXPECT_TRUE(plug["space"].is_null());
  EXPECT_TRUE(plug["space_unknown"].is_null());
}

TEST(Visibility, NothingInRangeOfACameraThatReadsNothingIsKnownForWhatItIs) {
  CommandScene scene;
  // The same depth all over is a dead camera.
  scene.lines.more += "watch: {min_at_robot: 0}\n";
  scene.write_scene();
  scene.surroundings = {kNoDepth, {{{0, 0, 64, 48}, kNoDepth}}, 0};
  scene.write_images();
  const Json link = link_of(scene.run().at(0), "upper");
  EXPECT_EQ(link["status"], "none_in_range");
  EXPECT_EQ(link["visibility"]["surface"]["seen"], 0);
  EXPECT_EQ(link["visibility"]["space_unknown"], 1);
}

TEST(Visibility, OffLeavesItOutOfJsonAndTableAndChangesNothingElse) {
  const CommandScene scene;
  std::vector<Json> on = scene.json({"run", "scene.yaml", "--visibility", "on"});
  EXPECT_EQ(on, scene.run());
  for (Json& frame : on) {
    for (Json& link : frame["links"]) EXPECT_EQ(link.erase("visibility"), 1U);
  }
  EXPECT_EQ(on, scene.json({"run", "scene.yaml", "--visibility", "off"}));
  EXPECT_NE(scene.berth({"run", "scene.yaml"}).out.find("  seen\n"), std::string::npos);
  EXPECT_EQ(scene.berth({"run", "scene.yaml", "--visibility", "off"}).out.find("seen"),
            std::string::npos);
}

TEST(Visibility, HelpNamesTheOption) {
  EXPECT_NE(CommandScene().berth({"run", "--help"}).out.find("--visibility"), std::string::npos);
}

}  // namespace
}  // namespace berth
