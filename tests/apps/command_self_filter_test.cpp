// Every key of scene.yaml's self_filter changes the fate of the pixels that it is about.
#include <gtest/gtest.h>

#include "tests/apps/command_scene.hpp"

namespace berth {
namespace {

/// Pixels of this fate in the first frame with these settings.
int count_with(CommandScene& scene, const std::string& settings, const char* fate) {
  scene.lines.self_filter = "{" + settings + "}";
  scene.lines.depth = "[depth/000000.png]";
  return scene.run().at(0)["self_filter"][fate];
}

/// What grows takes the wall, 1 m behind the robot.
constexpr const char* kOff = "padding_m: 0, padding_depth_m: 2, edge_jump_m: 0, island_radius_m: 0";

std::string with_off(const std::string& setting) { return std::string(kOff) + ", " + setting; }

/// The robot's readings are 5 cm before its model, at 1.8 to 2 m.
class Tolerance : public ::testing::Test {
 protected:
  Tolerance() {
    scene.surroundings.robot_offset_m = -0.05;
    scene.write_images();
  }
  CommandScene scene;
};

TEST_F(Tolerance, ConstantPartDecidesWhatIsRobot) {
  EXPECT_EQ(count_with(scene, with_off("tolerance_m: 0.048"), "robot"), 0);
  EXPECT_GT(count_with(scene, with_off("tolerance_m: 0.052"), "robot"), 100);
}

TEST_F(Tolerance, GrowsWithDepth) {
  EXPECT_EQ(count_with(scene, with_off("tolerance_m: 0.01, tolerance_per_m: 0.015"), "robot"), 0);
  EXPECT_GT(count_with(scene, with_off("tolerance_m: 0.01, tolerance_per_m: 0.025"), "robot"), 100);
}

TEST_F(Tolerance, GrowsWithTheSquareOfDepth) {
  EXPECT_EQ(count_with(scene, with_off("tolerance_m: 0, tolerance_per_m2: 0.01"), "robot"), 0);
  EXPECT_GT(count_with(scene, with_off("tolerance_m: 0, tolerance_per_m2: 0.02"), "robot"), 100);
}

TEST(SelfFilterKey, PaddingGrowsTheSilhouette) {
  CommandScene scene;
  EXPECT_EQ(count_with(scene, kOff, "padding"), 0);
  const std::string rest = "edge_jump_m: 0, island_radius_m: 0, padding_depth_m: ";
  const int some = count_with(scene, rest + "2, padding_m: 0.05", "padding");
  const int more = count_with(scene, rest + "2, padding_m: 0.1", "padding");
  EXPECT_GT(some, 20);
  EXPECT_GT(more, 1.5 * some);
  EXPECT_LT(count_with(scene, rest + "0.3, padding_m: 0.1", "padding"), some);
}

TEST(SelfFilterKey, LinkPaddingIsThatOfOneLink) {
  CommandScene scene;
  const int lower = count_with(scene, with_off("link_padding_m: {lower: 0.1}"), "padding");
  const int upper = count_with(scene, with_off("link_padding_m: {upper: 0.1}"), "padding");
  const int both =
      count_with(scene, with_off("link_padding_m: {lower: 0.1, upper: 0.1}"), "padding");
  EXPECT_GT(lower, 10);
  EXPECT_GT(upper, 10);
  EXPECT_GT(both, std::max(lower, upper));
  EXPECT_LE(both, lower + upper);
}

TEST(SelfFilterKey, EnvironmentPaddingIsThatOfScenery) {
  CommandScene scene;
  const int table = count_with(scene, with_off("environment_padding_m: 0.1"), "padding");
  EXPECT_GT(table, 10);
  const std::string rest = "edge_jump_m: 0, island_radius_m: 0, padding_depth_m: 2, ";
  const int all = count_with(scene, rest + "padding_m: 0.1", "padding");
  const int arm = count_with(scene, rest + "padding_m: 0.1, environment_padding_m: 0", "padding");
  EXPECT_GT(all, std::max(arm, table));
  EXPECT_LE(all, arm + table);
}

TEST(SelfFilterKey, DilationGrowsTheSilhouetteByPixels) {
  CommandScene scene;
  EXPECT_EQ(count_with(scene, kOff, "dilation"), 0);
  const int one = count_with(scene, with_off("dilation_px: 1"), "dilation");
  EXPECT_GT(one, 20);
  EXPECT_GT(count_with(scene, with_off("dilation_px: 2"), "dilation"), 1.5 * one);
}

TEST(SelfFilterKey, MixedPixelsAreDroppedByTheirJump) {
  CommandScene scene;
  // Beside the box, half a metre behind it and 0.8 m before the wall; the jump grows with z^2.
  scene.surroundings.rectangles.push_back({{56, 12, 57, 20}, 2.2});
  scene.write_images();
  const std::string rest = "padding_m: 0, island_radius_m: 0, ";
  EXPECT_EQ(count_with(scene, rest + "edge_jump_m: 0", "edge"), 0);
  EXPECT_GT(count_with(scene, rest + "edge_jump_m: 0.09", "edge"), 0);
  EXPECT_EQ(count_with(scene, rest + "edge_jump_m: 0.12", "edge"), 0);
}

/// A patch of 2 x 3 pixels, 7 cm wide, that the sensor makes up beside the upper link at its depth.
class Island : public ::testing::Test {
 protected:
  Island() {
    scene.surroundings.rectangles.push_back({{34, 24, 36, 27}, 1.985});
    scene.write_images();
  }
  CommandScene scene;
};

TEST_F(Island, IsDroppedWhereItLiesWhollyWithinTheRadius) {
  const std::string rest = "padding_m: 0, edge_jump_m: 0, ";
  EXPECT_EQ(count_with(scene, rest + "island_radius_m: 0", "island"), 0);
  EXPECT_EQ(count_with(scene, rest + "island_radius_m: 0.02", "island"), 0);
  EXPECT_EQ(count_with(scene, rest + "island_radius_m: 0.12", "island"), 6);
}

TEST_F(Island, IsNoneWhereTheJumpConnectsItToTheWall) {
  const std::string rest = "padding_m: 0, edge_jump_m: 0, island_radius_m: 0.12, ";
  EXPECT_EQ(count_with(scene, rest + "island_jump_m: 0.03", "island"), 6);
  EXPECT_EQ(count_with(scene, rest + "island_jump_m: 1.2", "island"), 0);
}

TEST(SelfFilterKey, RegionIgnoresWhatIsNotSeenThroughTheEnlargedRobot) {
  CommandScene scene;
  EXPECT_EQ(count_with(scene, kOff, "outside_region"), 0);
  const int all = count_with(scene, kOff, "obstacle");
  const int small = count_with(scene, with_off("robot_region_scale: 1.5"), "outside_region");
  const int large = count_with(scene, with_off("robot_region_scale: 3"), "outside_region");
  EXPECT_GT(large, 100);
  EXPECT_GT(small, large);
  EXPECT_LT(small, all);
  EXPECT_EQ(count_with(scene, with_off("robot_region_scale: 1.5"), "obstacle"), all - small);
  // Enlarged a hundred times the robot covers the image.
  EXPECT_EQ(count_with(scene, with_off("robot_region_scale: 100"), "outside_region"), 0);
}

}  // namespace
}  // namespace berth
