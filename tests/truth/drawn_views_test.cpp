#include "sim/drawn_views.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/same_bits.hpp"

namespace berth::sim {
namespace {

constexpr DrawnSceneSettings kSmallViews{.width_px = 160, .height_px = 120};

class DrawnViewsTest : public ::testing::Test {
 protected:
  const RobotModel model_ = load_robot({.urdf = BERTH_BUNDLED_ARM "/arm.urdf",
                                        .package_paths = {{"berth_arm", BERTH_BUNDLED_ARM}},
                                        .environment_links = {"table"}});
  const std::vector<MeshTree> trees_ = build_link_trees(model_);
};

TEST_F(DrawnViewsTest, TheFirstOneIsTheDrawnScene) {
  const DrawnScene scene = draw_scene(model_, trees_, kSmallViews, 4);
  const DrawnViews drawn = draw_views(model_, trees_, kSmallViews, 4, 2);
  EXPECT_TRUE(same_bits(drawn.views[0].depth_m, scene.depth_m));
  EXPECT_TRUE(same_bits(drawn.views[0].obstacles.depth_m, scene.obstacle_depth_m));
  EXPECT_TRUE(same_bits(drawn.views[0].robot.depth_m, scene.robot.depth_m));
}

TEST_F(DrawnViewsTest, MoreCamerasLeaveTheOthersAsTheyAre) {
  const DrawnViews two = draw_views(model_, trees_, kSmallViews, 5, 2);
  const DrawnViews four = draw_views(model_, trees_, kSmallViews, 5, 4);
  ASSERT_EQ(four.views.size(), 4U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(same_bits(two.views[i].depth_m, four.views[i].depth_m));
  }
  EXPECT_NE(four.views[0].camera.width_px, four.views[1].camera.width_px);
}

TEST_F(DrawnViewsTest, EachSeesTheRobotAndTellsTheFateOfEachPixel) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    for (const DrawnView& view : draw_views(model_, trees_, kSmallViews, seed, 4).views) {
      EXPECT_GT(view.obstacles.count_of(PixelFate::robot), 0);
      std::int64_t pixels = 0;
      for (const std::int64_t count : view.obstacles.count) pixels += count;
      EXPECT_EQ(pixels, view.camera.width_px * view.camera.height_px);
      for (std::size_t i = 0; i < view.depth_m.pixels().size(); ++i) {
        const PixelFate fate = view.obstacles.fate.pixels()[i];
        EXPECT_EQ(std::isnan(view.obstacles.depth_m.pixels()[i]), !is_kept(fate));
        EXPECT_EQ(std::isnan(view.depth_m.pixels()[i]), fate == PixelFate::no_reading);
      }
    }
  }
}

}  // namespace
}  // namespace berth::sim
