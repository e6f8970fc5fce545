// From a scene file to results: a camera that was bumped.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "berth/results/result_json.hpp"
#include "berth/scene/former_settings.hpp"
#include "berth/scene/scene_file.hpp"
#include "berth/scene/scene_run.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

using Json = nlohmann::json;

TEST(WatchInScenes, ACamerasOwnKeysGoOverThoseOfTheScene) {
  SceneText text;
  text.more_camera = "watch: {max_seen_through: 0.07, min_at_robot: 0.3}";
  text.end += "\nwatch: {max_seen_through: 0.04, max_displacement_m: 0.02, min_at_robot: 0.2}";
  const WatchSettings watch = read_text(text).cameras[0].settings.watch;
  EXPECT_EQ(watch.max_seen_through, 0.07);
  EXPECT_EQ(watch.max_displacement_m, 0.02);
  EXPECT_EQ(watch.min_at_robot, 0.3);
  text.more_camera = "watch: {max_seen: 0.07}";
  expect_parts(error_message([&] { read_text(text); }), {"max_seen", "max_seen_through"});
}

TEST(WatchInScenes, ABiasMayLieBeforeTheModel) {
  SceneText text;
  text.more_camera = "watch: {bias_m: -0.002}";
  EXPECT_EQ(read_text(text).cameras[0].settings.watch.bias_m, -0.002);
  text.more_camera = "self_filter: {padding_m: -0.002}";
  expect_parts(error_message([&] { read_text(text); }), {"padding_m", "-0.002", "0 or more"});
}

/// Four images of each of the bundled cameras; the camera `left` was turned by 3 degrees.
SceneFile bumped_scene() {
  SceneFile scene = read_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml");
  for (SceneCamera& camera : scene.cameras) {
    camera.depth.resize(4);
    camera.stamps_s.resize(4);
    camera.settings.watch = {.max_seen_through = 0.03, .agreeing_frames = 2, .frames = 2};
    if (camera.name == "left") {
      camera.X_PC.rotate(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()));
    }
  }
  return scene;
}

TEST(WatchInScenes, OfSeveralCamerasTheOneThatMovedIsNamedAndTheOthersAnswer) {
  const OpenScene scene = open_scene(bumped_scene());
  SceneRun run(scene);
  Json line;
  while (run.next()) line = Json::parse(result_json(run.ask()));
  ASSERT_EQ(line["cameras"].size(), 3U);
  for (const Json& camera : line["cameras"]) {
    const bool is_left = camera["camera"] == "left";
    EXPECT_EQ(camera["status"], is_left ? "moved" : "ok");
    EXPECT_EQ(camera["seen_through"] > 0.03, is_left);
    EXPECT_TRUE(camera["displacement_m"].is_null());
  }
  EXPECT_EQ(line["time"]["status"], "ok");
  EXPECT_EQ(line["status"], "degraded");
  for (const Json& link : line["links"]) {
    EXPECT_NE(link["camera"], "left");
    EXPECT_NE(link["status"], "stale");
  }
}

TEST(WatchInScenes, WithoutItNothingIsKnown) {
  SceneFile file = bumped_scene();
  for (SceneCamera& camera : file.cameras) camera.settings.watch = {};
  const OpenScene scene = open_scene(file);
  SceneRun run(scene);
  while (run.next()) {
    const Json line = Json::parse(result_json(run.ask()));
    for (const Json& camera : line["cameras"]) {
      EXPECT_NE(camera["status"], "moved");
      EXPECT_TRUE(camera["seen_through"].is_null());
    }
  }
}

SceneFile scene_with(const std::string& settings) {
  return parse_scene("scene.yaml",
                     "robot: {urdf: r.urdf}\n"
                     "cameras:\n"
                     "  - {name: c, info: i.yaml, pose: {parent: b, xyz: [0, 0, 0], rpy: [0, 0, "
                     "0]}, depth: [d.png]}\n"
                     "joints: j.csv\n" +
                         settings);
}

TEST(FormerSettings, ThoseThatEndedAreToldAndHaveNoEffect) {
  const SceneFile scene = scene_with(
      "separation: {hold_s: 0.3, release_m: 0.05, directed_speed: true, intrusion_m: 0.2}\n");
  EXPECT_EQ(
      scene.warnings,
      (std::vector<std::string>{
          "scene.yaml:5: separation.hold_s is no setting any more, and has no effect",
          "scene.yaml:5: separation.release_m is no setting any more, and has no effect",
          "scene.yaml:5: separation.directed_speed is no setting any more, and has no effect"}));
}

TEST(FormerSettings, MethodsOnImagesAreToldWithWhatHasThemNow) {
  EXPECT_EQ(scene_with("evaluation: {method: exact, range_m: 2, step_x: 3}\n").warnings,
            (std::vector<std::string>{
                "scene.yaml:5: evaluation.method is no setting any more, and has no effect; delete "
                "it; berth evaluate SCENE.yaml --method compares images",
                "scene.yaml:5: evaluation.step_x is no setting any more, and has no effect; berth "
                "evaluate compares images, and has it as an option"}));
}

TEST(FormerSettings, EachGroupMayNameThoseThatEnded) {
  for (const std::string group :
       {"space", "self_filter", "sensor", "evaluation", "watch", "time", "separation"}) {
    ASSERT_FALSE(ended_settings(group).empty()) << group;
    for (const std::string_view key : ended_settings(group)) {
      if (key == "holes") continue;  // its values are told apart below
      const std::string text = group + ": {" + std::string(key) + ": 1" +
                               (group == "separation" ? ", intrusion_m: 0.2}\n" : "}\n");
      const auto warnings = scene_with(text).warnings;
      ASSERT_EQ(warnings.size(), 1) << text;
      EXPECT_EQ(
          warnings[0].find("scene.yaml:5: " + group + "." + std::string(key) + " is no setting"), 0)
          << warnings[0];
    }
  }
}

TEST(FormerSettings, HolesThatWereObstaclesAreRefusedWithWhatToDoInstead) {
  EXPECT_EQ(scene_with("sensor: {holes: free}\n").warnings,
            std::vector<std::string>{
                "scene.yaml:5: sensor.holes is no setting any more, and has no effect"});
  const std::string message = error_message([] { scene_with("sensor: {holes: obstacle}\n"); });
  EXPECT_NE(message.find("scene.yaml:5: sensor.holes: obstacle; expected space.no_reading: hides"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace berth
