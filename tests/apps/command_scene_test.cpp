// What the commands make of a scene as a whole; what each key says is tested in tests/scene, and
// what it does beside its code.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "berth/files/png.hpp"
#include "tests/apps/command_scene.hpp"
#include "tests/apps/refusal.hpp"

namespace berth {
namespace {

double distance_of(const Json& frame, const char* name) {
  return link_of(frame, name)["distance_m"];
}

Eigen::Vector3d robot_point_B(const Json& frame, const char* name) {
  const Json p = link_of(frame, name)["robot_point_base_m"];
  return {p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>()};
}

TEST(SceneKey, StampsAreAnsweredBetweenRows) {
  CommandScene scene;
  scene.lines.depth = "[depth/000000.png]";
  scene.write("joints.csv", "time,shoulder,elbow\n0.5,0.375,0.15\n");
  scene.write_image("depth/000000.png", {0.375, 0.15}, front_pose());
  const Json at_row = scene.run().at(0);
  scene.write("joints.csv", "time,shoulder,elbow\n-1,0,0.9\n0,0.25,0\n1,0.5,0.3\n");
  scene.lines.more_camera = "stamps: [0.5]";
  scene.lines.more = "time: {max_skew_s: 0.5}\nwatch: {min_at_robot: 0}";
  const Json between = scene.run().at(0);
  EXPECT_EQ(between["stamp_s"], 0.5);
  EXPECT_EQ(between["time"]["skew_s"], 0.5);
  EXPECT_EQ(between["links"], at_row["links"]);
  EXPECT_EQ(between["cameras"][0]["self_filter"], at_row["cameras"][0]["self_filter"]);
  scene.lines.more_camera = "stamps: [0.9]";
  EXPECT_NE(scene.run().at(0)["links"], at_row["links"]);
}

TEST(SceneKey, CameraOnAMovingLinkMovesWithIt) {
  CommandScene scene;
  const Pose X_upper_C = Eigen::Translation3d(0, -1.5, 0.2) *
                         Eigen::AngleAxisd(-std::numbers::pi / 2, Eigen::Vector3d::UnitX());
  scene.lines.pose = "{parent: upper, xyz: [0, -1.5, 0.2], rpy: [-1.5707963267948966, 0, 0]}";
  for (int i = 0; i < 3; ++i) {
    const Pose X_BC = turned_about_y(kPositions[i].shoulder_rad) * X_upper_C;
    scene.write_image("depth/00000" + std::to_string(i) + ".png", kPositions[i], X_BC);
  }
  const std::vector<Json> frames = scene.run();
  ASSERT_EQ(frames.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    const Pose X_BC = turned_about_y(kPositions[i].shoulder_rad) * X_upper_C;
    const Json p = link_of(frames[i], "lower")["robot_point_camera_m"];
    const Eigen::Vector3d point_C(p.at(0).get<double>(), p.at(1).get<double>(),
                                  p.at(2).get<double>());
    EXPECT_LT((X_BC * point_C - robot_point_B(frames[i], "lower")).norm(), 1e-5);
    EXPECT_EQ(link_of(frames[i], "upper")["robot_pixels"],
              link_of(frames[0], "upper")["robot_pixels"]);
    EXPECT_GT(distance_of(frames[i], "upper"), 0.1) << "the robot is not filtered out";
  }
}

/// Pixels of padding in the first frame with these paddings of links, which take the wall too.
int padding_with(CommandScene& scene, const std::string& links) {
  scene.lines.self_filter =
      "{padding_m: 0, flying_patch_radius_m: 0, "
      "link_padding_m: {" +
      links + "}}";
  scene.surroundings.wall_m = 2.2;
  scene.write_images();
  scene.lines.depth = "[depth/000000.png]";
  scene.lines.more_camera = "stamps: [0]";
  return scene.run().at(0)["cameras"][0]["self_filter"]["padding"];
}

TEST(SceneKey, LinkPaddingIsThatOfOneLink) {
  CommandScene scene;
  const int lower = padding_with(scene, "lower: 0.1");
  const int upper = padding_with(scene, "upper: 0.1");
  const int both = padding_with(scene, "lower: 0.1, upper: 0.1");
  EXPECT_GT(lower, 10);
  EXPECT_GT(upper, 10);
  EXPECT_GT(both, std::max(lower, upper));
  EXPECT_LE(both, lower + upper);
}

TEST(SceneKey, BackgroundIsLearnedFromAllImagesOfTheScene) {
  CommandScene scene;
  const auto count_with = [&](int frames) -> int {
    scene.lines.more = "sensor: {background_frames: " + std::to_string(frames) + "}";
    return scene.run().at(0)["cameras"][0]["self_filter"]["background"];
  };
  EXPECT_EQ(count_with(0), 0);
  const int often = count_with(1);
  const int seldom = count_with(2);
  EXPECT_GT(often, 20);
  EXPECT_GT(seldom, 0);
  EXPECT_LT(seldom, often);
  EXPECT_EQ(count_with(4), 0);
}

TEST(SceneKey, BackgroundIsWhatFilterWritesToo) {
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

TEST(SceneKey, BackgroundIsRefusedForACameraThatMovesWithTheRobot) {
  CommandScene scene;
  scene.lines.pose = "{parent: lower, xyz: [0, -2, 0.3], rpy: [-1.5707963267948966, 0, 0]}";
  scene.lines.more = "sensor: {background_frames: 1}";
  expect_refused(scene, {"run", "scene.yaml"},
                 {"scene.yaml: sensor.background_frames: 1, but the camera's parent link "
                  "\"lower\" moves with joint \"elbow\"",
                  "expected 0, or a camera that is fixed to the root link \"base\""});
}

TEST(SceneKey, CommandLineWinsOverTheScene) {
  CommandScene scene;
  scene.lines.evaluation = "{range_m: 0.2, mean_direction: false}";
  const Json frame =
      scene.json({"run", "scene.yaml", "--range", "2", "--mean-direction", "on"}).at(0);
  EXPECT_EQ(frame["range_m"], 2);
  EXPECT_EQ(link_of(frame, "upper")["status"], "ok");
  EXPECT_GT(link_of(frame, "upper")["mean_count"], 0);
}

}  // namespace
}  // namespace berth
