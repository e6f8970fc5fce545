// Every key of scene.yaml about robot, cameras, joints and evaluation changes what `berth run`
// gives.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/apps/command_scene.hpp"

namespace berth {
namespace {

int count_of(const Json& frame, const char* fate) { return frame["self_filter"][fate]; }

double distance_of(const Json& frame, const char* name) {
  return link_of(frame, name)["distance_m"];
}

Eigen::Vector3d robot_point_B(const Json& frame, const char* name) {
  const Json p = link_of(frame, name)["robot_point_base_m"];
  return {p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>()};
}

void replace(std::string& text, const std::string& old_text, const std::string& new_text) {
  ASSERT_NE(text.find(old_text), std::string::npos) << old_text;
  text.replace(text.find(old_text), old_text.size(), new_text);
}

TEST(SceneKey, PackagePathsSayWhereMeshesAre) {
  CommandScene scene;
  replace(scene.lines.robot, "arm_parts: parts", "arm_parts: elsewhere");
  std::filesystem::rename(scene / "parts", scene / "elsewhere");
  EXPECT_GT(link_of(scene.run().at(0), "lower")["robot_pixels"], 10);
}

TEST(SceneKey, CollisionGeometryIsTakenWhereItIsAskedFor) {
  CommandScene scene;
  const Json visual = scene.run().at(0);
  replace(scene.lines.robot, "}, env", "}, geometry: collision, env");
  const Json collision = scene.run().at(0);
  EXPECT_GT(link_of(collision, "upper")["robot_pixels"],
            1.3 * link_of(visual, "upper")["robot_pixels"].get<int>());
  EXPECT_EQ(link_of(collision, "base")["robot_pixels"], link_of(visual, "base")["robot_pixels"]);
}

TEST(SceneKey, LinkThatIsNoEnvironmentLinkIsEvaluated) {
  CommandScene scene;
  const Json scenery = scene.run().at(0);
  EXPECT_TRUE(link_of(scenery, "table").is_null());
  replace(scene.lines.robot, ", environment_links: [table]", "");
  const Json evaluated = scene.run().at(0);
  EXPECT_EQ(link_of(evaluated, "table")["robot_pixels"], count_of(scenery, "environment"));
  EXPECT_EQ(count_of(evaluated, "environment"), 0);
  EXPECT_EQ(count_of(evaluated, "obstacle"), count_of(scenery, "obstacle"));
}

TEST(SceneKey, IgnoredLinkStaysInTheImageAsAnObstacle) {
  CommandScene scene;
  const Json all = scene.run().at(0);
  replace(scene.lines.robot, "[table]", "[table], ignore_links: [lower]");
  const Json ignored = scene.run().at(0);
  EXPECT_TRUE(link_of(ignored, "lower").is_null());
  EXPECT_EQ(count_of(ignored, "obstacle"),
            count_of(all, "obstacle") + link_of(all, "lower")["robot_pixels"].get<int>());
  EXPECT_GT(distance_of(all, "upper"), 0.2);
  EXPECT_LT(distance_of(ignored, "upper"), 0.05);
}

TEST(SceneKey, MimicJointFollowsItsMaster) {
  const CommandScene scene;
  const std::vector<Json> frames = scene.run();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Positions& p = kPositions[i];
    const Pose X_B_lower = turned_about_y(p.shoulder_rad) * Eigen::Translation3d(0, 0, 0.5) *
                           turned_about_y(p.elbow_rad);
    const Eigen::Vector3d point = X_B_lower.inverse() * robot_point_B(frames[i], "finger");
    const double begin_m = 0.3 + 0.2 * p.elbow_rad + 0.1;
    const double pixel_m = 2.0 / 60;
    EXPECT_GT(point.z(), begin_m - pixel_m) << i;
    EXPECT_LT(point.z(), begin_m + 0.1 + pixel_m) << i;
  }
}

TEST(SceneKey, ColumnOfAMimicJointIsAcceptedAndNotUsed) {
  const CommandScene scene;
  const std::vector<Json> without = scene.run();
  scene.write("joints.csv", "time,slide,elbow,shoulder\n0,9,0,0\n1,9,0.3,0.5\n2,9,0.6,-0.4\n");
  EXPECT_EQ(scene.run(), without);
}

TEST(SceneKey, JointsNamesTheFile) {
  CommandScene scene;
  const std::vector<Json> before = scene.run();
  std::filesystem::rename(scene / "joints.csv", scene / "angles.csv");
  scene.lines.joints = "angles.csv";
  EXPECT_EQ(scene.run(), before);
}

TEST(SceneKey, StampsAreAnsweredBetweenRows) {
  CommandScene scene;
  scene.lines.depth = "[depth/000000.png]";
  scene.write("joints.csv", "time,shoulder,elbow\n0.5,0.375,0.15\n");
  scene.write_image("depth/000000.png", {0.375, 0.15}, front_pose());
  const Json at_row = scene.run().at(0);
  scene.write("joints.csv", "time,shoulder,elbow\n-1,0,9\n0,0.25,0\n1,0.5,0.3\n");
  scene.lines.more_camera = "stamps: [0.5]";
  const Json between = scene.run().at(0);
  EXPECT_EQ(between["stamp_s"], 0.5);
  EXPECT_EQ(between["time"]["skew_s"], 0.5);
  EXPECT_EQ(between["links"], at_row["links"]);
  EXPECT_EQ(between["self_filter"], at_row["self_filter"]);
  scene.lines.more_camera = "stamps: [0.9]";
  EXPECT_NE(scene.run().at(0)["links"], at_row["links"]);
}

TEST(SceneKey, CameraNameAndInfoAreUsed) {
  CommandScene scene;
  // The images are those of another camera.
  scene.lines.more += "watch: {min_at_robot: 0}\n";
  const Json before = scene.run().at(0);
  scene.lines.name = "other";
  scene.lines.info = "other.yaml";
  scene.write("other.yaml", camera_info_text("[30, 0, 31.5, 0, 30, 23.5, 0, 0, 1]"));
  const Json after = scene.run().at(0);
  EXPECT_EQ(after["camera"], "other");
  EXPECT_LT(link_of(after, "upper")["robot_pixels"],
            0.5 * link_of(before, "upper")["robot_pixels"].get<int>());
}

TEST(SceneKey, QuaternionAndRpyArePosesAlike) {
  CommandScene scene;
  // The images are those of another camera.
  scene.lines.more += "watch: {min_at_robot: 0}\n";
  const Json rpy = scene.run().at(1);
  scene.lines.pose =
      "{parent: base, xyz: [0, -2, 0.3], quaternion_xyzw: [-0.7071067811865476, 0, 0, "
      "0.7071067811865476]}";
  const Json quaternion = scene.run().at(1);
  EXPECT_EQ(count_of(quaternion, "robot"), count_of(rpy, "robot"));
  EXPECT_NEAR(distance_of(quaternion, "upper"), distance_of(rpy, "upper"), 1e-5);
  scene.lines.pose = "{parent: base, xyz: [0.5, -2, 0.3], rpy: [-1.5707963267948966, 0, 0]}";
  EXPECT_NE(scene.run().at(1)["links"], rpy["links"]);
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
    const Json p = link_of(frames[i], "lower")["robot_point_m"];
    const Eigen::Vector3d point_C(p.at(0).get<double>(), p.at(1).get<double>(),
                                  p.at(2).get<double>());
    EXPECT_LT((X_BC * point_C - robot_point_B(frames[i], "lower")).norm(), 1e-5);
    EXPECT_EQ(link_of(frames[i], "upper")["robot_pixels"],
              link_of(frames[0], "upper")["robot_pixels"]);
    EXPECT_GT(distance_of(frames[i], "upper"), 0.1) << "the robot is not filtered out";
  }
}

TEST(SceneKey, DepthCanBeAPattern) {
  CommandScene scene;
  const std::vector<Json> list = scene.run();
  scene.lines.depth = "depth/*.png";
  EXPECT_EQ(scene.run(), list);
}

TEST(SceneKey, DepthScaleIsTheUnitOfTheImages) {
  CommandScene scene;
  const Json mm = scene.run().at(0);
  scene.lines.depth = "[depth/000000.png]";
  scene.lines.more_camera = "depth_scale: 0.0005";
  scene.write_image("depth/000000.png", kPositions[0], front_pose(), 0.0005);
  const Json half_mm = scene.run().at(0);
  EXPECT_EQ(count_of(half_mm, "robot"), count_of(mm, "robot"));
  EXPECT_NEAR(distance_of(half_mm, "upper"), distance_of(mm, "upper"), 1e-3);
}

TEST(SceneKey, DepthScaleIsAMillimetreUnlessGiven) {
  CommandScene scene;
  const std::vector<Json> given = scene.run();
  scene.lines.more_camera = "";
  EXPECT_EQ(scene.run(), given);
}

TEST(SceneKey, ReadingsNearerThanNearAreNone) {
  CommandScene scene;
  const Json before = scene.run().at(0);
  scene.lines.more_camera = "near_m: 1.71";
  const Json after = scene.run().at(0);
  const int box_pixels = 8 * 8;
  EXPECT_GE(count_of(after, "no_reading"), box_pixels);
  EXPECT_EQ(count_of(after, "obstacle"), count_of(before, "obstacle") - box_pixels);
}

TEST(SceneKey, ReadingsBeyondFarAreNone) {
  CommandScene scene;
  scene.lines.more_camera = "far_m: 2.99";
  const Json frame = scene.run().at(0);
  EXPECT_EQ(count_of(frame, "obstacle"), 8 * 8);
  EXPECT_EQ(count_of(frame, "no_reading"),
            64 * 48 - 8 * 8 - count_of(frame, "robot") - count_of(frame, "environment"));
}

TEST(SceneKey, EvaluationMethodAndRangeAreUsed) {
  CommandScene scene;
  scene.lines.evaluation = "{method: brute_force, range_m: 0.2}";
  const Json frame = scene.run().at(0);
  EXPECT_EQ(frame["method"], "brute_force");
  EXPECT_EQ(frame["range_m"], 0.2);
  EXPECT_EQ(link_of(frame, "upper")["status"], "none_in_range");
}

TEST(SceneKey, MeanDirectionCanBeTurnedOff) {
  CommandScene scene;
  EXPECT_GT(link_of(scene.run().at(0), "upper")["mean_count"], 0);
  scene.lines.evaluation = "{method: exact, range_m: 2, mean_direction: false}";
  const Json link = link_of(scene.run().at(0), "upper");
  EXPECT_EQ(link["status"], "ok");
  EXPECT_EQ(link["mean_count"], 0);
  EXPECT_TRUE(link["mean_direction"].is_null());
}

TEST(SceneKey, VisibilityCanBeTurnedOff) {
  CommandScene scene;
  scene.lines.evaluation = "{method: exact, range_m: 2, visibility: false}";
  EXPECT_FALSE(link_of(scene.run().at(0), "upper").contains("visibility"));
  const Json on = scene.json({"run", "scene.yaml", "--visibility", "on"}).at(0);
  EXPECT_TRUE(link_of(on, "upper").contains("visibility"));
}

TEST(SceneKey, CommandLineWinsOverTheScene) {
  CommandScene scene;
  scene.lines.evaluation = "{method: brute_force, range_m: 0.2, mean_direction: false}";
  const Json frame = scene
                         .json({"run", "scene.yaml", "--method", "exact", "--range", "2",
                                "--mean-direction", "on"})
                         .at(0);
  EXPECT_EQ(frame["method"], "exact");
  EXPECT_EQ(frame["range_m"], 2);
  EXPECT_EQ(link_of(frame, "upper")["status"], "ok");
  EXPECT_GT(link_of(frame, "upper")["mean_count"], 0);
}

TEST(SceneKey, SelfFilterAndEvaluationHaveDefaults) {
  CommandScene scene;
  const std::string text = scene.lines.text();
  scene.write("short.yaml", text.substr(0, text.find("self_filter:")));
  const Json frame = scene.json({"run", "short.yaml"}).at(0);
  EXPECT_EQ(frame["method"], "mesh");
  EXPECT_EQ(frame["range_m"], 1);
  scene.lines.self_filter =
      "{tolerance_m: 0.05, padding_m: 0.02, padding_depth_m: 0.3, dilation_px: 0, edge_jump_m: "
      "0.03, "
      "island_radius_m: 0.07, island_jump_m: 0.03, robot_region_scale: 0}";
  scene.lines.evaluation = "{method: mesh, range_m: 1, mean_direction: true, visibility: true, min_seen_share: 0.02}";
  EXPECT_EQ(scene.run().at(0), frame);
}

}  // namespace
}  // namespace berth
