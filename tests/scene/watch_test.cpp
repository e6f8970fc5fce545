// From a scene file to results: a camera that was bumped.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "berth/results/result_json.hpp"
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

}  // namespace
}  // namespace berth
