// Every key of scene.yaml's sensor changes the fate of the pixels that it is about.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "berth/files/png.hpp"
#include "tests/apps/command_scene.hpp"
#include "tests/apps/refusal.hpp"

namespace berth {
namespace {

/// The frames' JSON with these settings of the sensor.
std::vector<Json> run_with(CommandScene& scene, const std::string& settings) {
  scene.lines.more = "sensor: {" + settings + "}";
  return scene.run();
}

/// Pixels of this fate in one frame.
int count_by_sensor(CommandScene& scene, const std::string& settings, const char* fate,
                    std::size_t frame = 0) {
  return run_with(scene, settings).at(frame)["self_filter"][fate];
}

TEST(SensorKey, SpeckleIsDroppedUpToItsSize) {
  CommandScene scene;
  scene.surroundings.rectangles.push_back({{4, 4, 6, 7}, 1.5});
  scene.write_images();
  EXPECT_EQ(count_by_sensor(scene, "", "speckle"), 0);
  EXPECT_EQ(count_by_sensor(scene, "speckle_px: 6", "speckle"), 0);
  EXPECT_EQ(count_by_sensor(scene, "speckle_px: 7", "speckle"), 6);
}

TEST(SensorKey, SpeckleJumpJoinsPixels) {
  CommandScene scene;
  scene.surroundings.rectangles.push_back({{4, 4, 6, 7}, 2.9});
  scene.write_images();
  EXPECT_EQ(count_by_sensor(scene, "speckle_px: 7, speckle_jump_m: 0.01", "speckle"), 6);
  EXPECT_EQ(count_by_sensor(scene, "speckle_px: 7, speckle_jump_m: 0.02", "speckle"), 0);
}

/// The second image's wall is 6 cm behind the first one's.
class Average : public ::testing::Test {
 protected:
  Average() {
    scene.write_image("depth/000000.png", kPositions[0], front_pose());
    scene.surroundings.wall_m = 3.06;
    scene.write_image("depth/000001.png", kPositions[1], front_pose());
  }
  CommandScene scene;
};

TEST_F(Average, FramesMoveReadingsTowardsTheCamera) {
  EXPECT_EQ(count_by_sensor(scene, "average_frames: 0", "averaged", 1), 0);
  EXPECT_EQ(count_by_sensor(scene, "average_frames: 1", "averaged", 1), 0);
  EXPECT_GT(count_by_sensor(scene, "average_frames: 2", "averaged", 1), 1000);
  EXPECT_EQ(count_by_sensor(scene, "average_frames: 2", "averaged", 0), 0);
}

TEST_F(Average, NoiseIsWhatTheMeanGoesOver) {
  EXPECT_EQ(count_by_sensor(scene, "average_frames: 2, noise_m: 0.006", "averaged", 1), 0);
  EXPECT_GT(count_by_sensor(scene, "average_frames: 2, noise_m: 0.007", "averaged", 1), 1000);
}

TEST(SensorKey, BackgroundIsLearnedFromAllImagesOfTheScene) {
  CommandScene scene;
  EXPECT_EQ(count_by_sensor(scene, "background_frames: 0", "background"), 0);
  const int often = count_by_sensor(scene, "background_frames: 1", "background");
  const int seldom = count_by_sensor(scene, "background_frames: 2", "background");
  EXPECT_GT(often, 20);
  EXPECT_GT(seldom, 0);
  EXPECT_LT(seldom, often);
  EXPECT_EQ(count_by_sensor(scene, "background_frames: 4", "background"), 0);
}

TEST(SensorKey, BackgroundIsNotLearnedWithinTheClearance) {
  CommandScene scene;
  const int near =
      count_by_sensor(scene, "background_frames: 1, background_clearance_m: 0", "background");
  const int far =
      count_by_sensor(scene, "background_frames: 1, background_clearance_m: 0.5", "background");
  EXPECT_GT(near, far);
}

TEST(SensorKey, BackgroundIsWhatFilterWritesToo) {
  CommandScene scene;
  scene.lines.more = "sensor: {background_frames: 1}";
  ASSERT_EQ(scene.berth({"filter", "scene.yaml", "--out", "with"}).exit_status, 0);
  scene.lines.more = "";
  ASSERT_EQ(scene.berth({"filter", "scene.yaml", "--out", "without"}).exit_status, 0);
  const auto count = [&](const char* folder) {
    const DepthImage depth_m =
        read_depth_png(scene / folder / "obstacle_depth_000000.png", scene_camera(), 0.001);
    return std::count_if(depth_m.pixels().begin(), depth_m.pixels().end(),
                         [](float z) { return !std::isnan(z); });
  };
  EXPECT_GT(count("with"), count("without") + 20);
}

TEST(SensorKey, BackgroundIsRefusedForACameraThatMovesWithTheRobot) {
  CommandScene scene;
  scene.lines.pose = "{parent: lower, xyz: [0, -2, 0.3], rpy: [-1.5707963267948966, 0, 0]}";
  scene.lines.more = "sensor: {background_frames: 1}";
  expect_refused(scene, {"run", "scene.yaml"},
                 {"scene.yaml: sensor.background_frames: 1, but the camera's parent link "
                  "\"lower\" moves with joint \"elbow\"",
                  "expected 0, or a camera that is fixed to the root link \"base\""});
}

TEST(SensorKey, HolesAreFilledByTheirPolicy) {
  CommandScene scene;
  scene.surroundings.rectangles.push_back({{4, 4, 6, 7}, kNoDepth});
  scene.write_images();
  EXPECT_EQ(count_by_sensor(scene, "holes: free", "no_reading"), 6);
  EXPECT_EQ(count_by_sensor(scene, "holes: free", "hole"), 0);
  EXPECT_EQ(count_by_sensor(scene, "holes: obstacle", "hole"), 6);
}

TEST(SensorKey, AnAverageOverTooManyFramesIsRefused) {
  CommandScene scene;
  scene.lines.more = "sensor: {average_frames: 101}";
  expect_refused(scene, {"run", "scene.yaml"},
                 {"sensor.average_frames: 101; expected a whole number from 0 to 100"});
}

}  // namespace
}  // namespace berth
