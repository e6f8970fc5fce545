#include "sim/drawn_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "berth/render/robot_renderer.hpp"
#include "sim/drawn_views.hpp"
#include "tests/support/known_arms.hpp"
#include "tests/support/same_bits.hpp"

namespace berth::sim {
namespace {

constexpr DrawnSceneSettings kSmall{.width_px = 160, .height_px = 120};

class DrawnScenes : public ::testing::Test {
 protected:
  DrawnScene draw(std::uint32_t seed) const { return draw_scene(model_, trees_, kSmall, seed); }

  const RobotModel model_ = load_robot(bundled_arm());
  const std::vector<MeshTree> trees_ = build_link_trees(model_);
};

/// Pixels whose depths differ by more than 1 mm, or where only one has any.
int count_differences(const DepthImage& a, const DepthImage& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const float x = a.pixels()[i];
    const float y = b.pixels()[i];
    if (!(std::isnan(x) && std::isnan(y)) && !(std::abs(x - y) < 1e-3F)) ++count;
  }
  return count;
}

TEST_F(DrawnScenes, DependOnTheSeedAlone) {
  EXPECT_TRUE(same_bits(draw(7).depth_m, draw(7).depth_m));
  EXPECT_FALSE(same_bits(draw(7).depth_m, draw(8).depth_m));
}

TEST_F(DrawnScenes, KeepJointsWithinTheirLimitsAndObstaclesClearOfTheRobot) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    const DrawnScene scene = draw(seed);
    ASSERT_EQ(scene.joints.position.size(), model_.joints.size());
    for (std::size_t i = 0; i < model_.joints.size(); ++i) {
      EXPECT_GE(scene.joints.position[i], model_.joints[i].lower);
      EXPECT_LE(scene.joints.position[i], model_.joints[i].upper);
    }
    EXPECT_GE(scene.obstacles.size(), 3U);
    for (const DrawnObstacle& obstacle : scene.obstacles) {
      const MeshTree tree = build_mesh_tree(obstacle.mesh_O);
      for (const std::size_t i : model_.evaluated_links) {
        EXPECT_GT(closest_points(trees_[i], scene.pose.X_BL[i], tree, obstacle.X_BO).distance_m, 0)
            << "seed " << seed << ", " << model_.links[i].name;
      }
    }
  }
}

TEST_F(DrawnScenes, ImagesAreWhatRobotRendererDrawsOfRobotAndObstacles) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const DrawnScene scene = draw(seed);
    RobotImage robot;
    RobotRenderer(build_link_meshes(model_), scene.camera).render(scene.pose, scene.X_BC, robot);
    RobotImage obstacles;
    RobotRenderer(build_link_meshes(obstacle_model(scene.obstacles)), scene.camera)
        .render(obstacle_pose(scene.obstacles), scene.X_BC, obstacles);
    DepthImage sensor_m = obstacles.depth_m;
    DepthImage ideal_m = obstacles.depth_m;
    for (std::size_t i = 0; i < sensor_m.pixels().size(); ++i) {
      const float robot_m = robot.depth_m.pixels()[i];
      if (std::isnan(robot_m) || sensor_m.pixels()[i] < robot_m) continue;
      sensor_m.pixels()[i] = robot_m;
      ideal_m.pixels()[i] = kNoDepth;
    }
    // Centres that lie on an edge.
    const int few = kSmall.width_px * kSmall.height_px / 1000;
    EXPECT_LE(count_differences(scene.robot.depth_m, robot.depth_m), few) << "seed " << seed;
    EXPECT_LE(count_differences(scene.depth_m, sensor_m), few) << "seed " << seed;
    EXPECT_LE(count_differences(scene.obstacle_depth_m, ideal_m), few) << "seed " << seed;
  }
}

TEST_F(DrawnScenes, ShowTheRobotAndItsObstacles) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    const DrawnScene scene = draw(seed);
    const auto& ids = scene.robot.link_id.pixels();
    EXPECT_GT(std::count_if(ids.begin(), ids.end(),
                            [](LinkId id) { return id != kNoLink && id != kEnvironmentLink; }),
              kSmall.width_px * kSmall.height_px / 100);
    const auto& left = scene.obstacle_depth_m.pixels();
    EXPECT_GT(std::count_if(left.begin(), left.end(), [](float z) { return z > 0; }), 1000);
  }
}

using DrawnViewsTest = DrawnScenes;

TEST_F(DrawnViewsTest, TheFirstOneIsTheDrawnScene) {
  const DrawnScene scene = draw_scene(model_, trees_, kSmall, 4);
  const DrawnViews drawn = draw_views(model_, trees_, kSmall, 4, 2);
  EXPECT_TRUE(same_bits(drawn.views[0].depth_m, scene.depth_m));
  EXPECT_TRUE(same_bits(drawn.views[0].obstacles.depth_m, scene.obstacle_depth_m));
  EXPECT_TRUE(same_bits(drawn.views[0].robot.depth_m, scene.robot.depth_m));
}

TEST_F(DrawnViewsTest, MoreCamerasLeaveTheOthersAsTheyAre) {
  const DrawnViews two = draw_views(model_, trees_, kSmall, 5, 2);
  const DrawnViews four = draw_views(model_, trees_, kSmall, 5, 4);
  ASSERT_EQ(four.views.size(), 4U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(same_bits(two.views[i].depth_m, four.views[i].depth_m));
  }
  EXPECT_NE(four.views[0].camera.width_px, four.views[1].camera.width_px);
}

TEST_F(DrawnViewsTest, EachSeesTheRobotAndTellsTheFateOfEachPixel) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    for (const DrawnView& view : draw_views(model_, trees_, kSmall, seed, 4).views) {
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
