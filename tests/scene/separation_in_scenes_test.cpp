// From a scene file's `separation:` to results.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "berth/results/result_json.hpp"
#include "berth/results/result_text.hpp"
#include "berth/scene/scene_run.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

using Json = nlohmann::json;

SeparationSettings read_separation_of(const std::string& text) {
  return *read_text(with(&SceneText::end, "joints: j.csv\nseparation: " + text)).separation;
}

TEST(SeparationInScenes, IsOffWhereTheFileHasNone) {
  EXPECT_FALSE(read_text(SceneText()).separation);
}

TEST(SeparationInScenes, HasItsDefaultsWhereTheMapIsEmpty) {
  EXPECT_EQ(read_separation_of("{}").human_speed_m_s, SeparationSettings().human_speed_m_s);
}

TEST(SeparationInScenes, WarnsOnceWhereNobodyHasShownWhatTheCamerasDetect) {
  const auto warnings = [](const std::string& text) {
    return read_text(with(&SceneText::end, "joints: j.csv\nseparation: " + text)).warnings;
  };
  ASSERT_EQ(warnings("{}").size(), 1U);
  expect_parts(warnings("{}").front(), {"scene.yaml:9", "0.85 m", "detection_m"});
  EXPECT_TRUE(warnings("{detection_m: 0.04}").empty());
  EXPECT_TRUE(warnings("{intrusion_m: 0.2}").empty());
  EXPECT_TRUE(read_text(SceneText()).warnings.empty());
}

TEST(SeparationInScenes, HasEveryKeyAndTheTable) {
  const SeparationSettings settings = read_separation_of(
      "{human_speed_m_s: 2, reaction_time_s: 0.2, deceleration_m_s2: 3, acceleration_m_s2: 4, "
      "intrusion_m: 0.1, detection_m: 0.03, camera_uncertainty_m: 0.05, robot_uncertainty_m: 0.02, "
      "contact_speed_m_s: 0.25, "
      "not_seen: assume_range, camera: ignore, no_reading: assume_range, rejected: stop, unknown: "
      "ignore, "
      "assumed_range_m: 0.5, stopping: [{speed_m_s: 0.5, time_s: 0.2, distance_m: 0.05}, "
      "{speed_m_s: 1, time_s: 0.3, distance_m: 0.2}]}");
  EXPECT_EQ(settings.human_speed_m_s, 2);
  EXPECT_EQ(settings.camera_uncertainty_m, 0.05);
  EXPECT_EQ(settings.intrusion_m, 0.1);
  EXPECT_EQ(settings.detection_m, 0.03);
  EXPECT_EQ(settings.contact_speed_m_s, 0.25);
  EXPECT_EQ(settings.not_seen, UnknownPolicy::assume_range);
  EXPECT_EQ(settings.camera, UnknownPolicy::ignore);
  EXPECT_EQ(settings.no_reading, UnknownPolicy::assume_range);
  EXPECT_EQ(settings.rejected, UnknownPolicy::stop);
  EXPECT_EQ(settings.unknown, UnknownPolicy::ignore);
  ASSERT_EQ(settings.stopping.size(), 2U);
  EXPECT_EQ(settings.stopping[1].speed_m_s, 1);
  EXPECT_EQ(settings.stopping[1].time_s, 0.3);
  EXPECT_EQ(settings.stopping[1].distance_m, 0.2);
}

TEST(SeparationInScenes, RefusesWhatIsWrongAndSaysWhere) {
  const auto message = [](const std::string& text) {
    return error_message([&] { read_separation_of(text); });
  };
  expect_parts(message("{human_sped_m_s: 1}"),
               {"scene.yaml:9", "human_sped_m_s", "human_speed_m_s"});
  expect_parts(message("{human_speed_m_s: -1}"), {"human_speed_m_s", "-1", "0 or more"});
  expect_parts(message("{camera: slow}"), {"camera", "slow", "stop, assume_range"});
  expect_parts(message("{stopping: [{speed_m_s: 1, time_s: 1}]}"), {"stopping", "distance_m"});
  expect_parts(message("{stopping: [{speed_m_s: 0, time_s: 1, distance_m: 1}]}"),
               {"speed_m_s", "0"});
}

/// The bundled scene's first images, with a robot that is hardly ever in somebody's way.
SceneFile monitored_scene() {
  SceneFile scene = read_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml");
  for (SceneCamera& camera : scene.cameras) {
    camera.depth.resize(4);
    camera.stamps_s.resize(4);
    camera.settings.watch.min_at_robot = 0;
  }
  scene.separation.emplace();
  scene.separation->camera = UnknownPolicy::ignore;
  scene.separation->no_reading = UnknownPolicy::ignore;
  scene.separation->human_speed_m_s = 0.1;
  scene.separation->intrusion_m = 0;
  scene.separation->acceleration_m_s2 = 0;
  scene.separation->camera_uncertainty_m = 0;
  scene.separation->deceleration_m_s2 = 1;
  return scene;
}

TEST(SeparationInScenes, WarnsWhereACameraTellsLessThanWasShown) {
  SceneFile file = monitored_scene();
  file.separation->intrusion_m.reset();
  file.separation->detection_m = 0.02;
  file.cameras[0].settings.space.detection_capability_m = 0.02;
  file.cameras[1].settings.space.detection_capability_m = 0.06;
  const OpenScene scene = open_scene(file);
  ASSERT_EQ(scene.warnings.size(), 2U);
  expect_parts(scene.warnings[0], {"scene.yaml: separation.detection_m: 0.02;", "at least",
                                   "\"left\", 0.06", "0.850 m"});
  expect_parts(scene.warnings[1], {"\"right\", 0.04", "C is 0.208 m"});
  file.separation->intrusion_m = 0.1;
  EXPECT_TRUE(reopen_scene(scene, file).warnings.empty());
}

TEST(SeparationInScenes, HasToChooseWhereACameraDoesNotTellWhatGivesNoReading) {
  SceneFile file = monitored_scene();
  file.separation->no_reading.reset();
  for (SceneCamera& camera : file.cameras) camera.settings.space.no_reading = NoReading::hides;
  const auto refusal = [&] {
    const OpenScene scene = open_scene(file);
    return error_message([&] { SceneRun run(scene); });
  };
  EXPECT_EQ(refusal(), "");
  file.cameras[1].settings.space.no_reading = NoReading::unknown;
  expect_parts(refusal(), {"scene.yaml: separation.no_reading: missing", "camera left",
                           "black clothes", "background", "space.no_reading: hides",
                           "separation.no_reading: ignore, assume_range or stop"});
  file.cameras[1].settings.sensor.background_frames = 1;
  EXPECT_EQ(refusal(), "");
  file.cameras[1].settings.sensor.background_frames = 0;
  file.separation->no_reading = UnknownPolicy::stop;
  EXPECT_EQ(refusal(), "");
}

TEST(SeparationInScenes, IsInEachLineOfJson) {
  const OpenScene scene = open_scene(monitored_scene());
  SceneRun run(scene);
  int reduced = 0;
  while (run.next()) {
    const Result result = run.ask();
    const Json line = Json::parse(result_json(result));
    const Json& separation = line["separation"];
    ASSERT_EQ(separation.size(), 8U);
    EXPECT_EQ(separation["state"], name_of(result.separation->state));
    EXPECT_EQ(separation["speed_scale"], result.separation->speed_scale);
    EXPECT_EQ(separation["text"], separation_text(result));
    EXPECT_GT(separation["reaction_time_s"], 0.0999);
    double least = 1;
    for (const Json& link : line["links"]) {
      EXPECT_EQ(link.contains("separation"), link["link"] != "arm_link_0");
      if (!link.contains("separation")) continue;
      const Json& of_link = link["separation"];
      EXPECT_NEAR(of_link["margin_m"],
                  double(of_link["distance_m"]) - double(of_link["required_m"]), 1e-9);
      least = std::min(least, double(of_link["speed_scale"]));
    }
    if (separation["state"] != "reduced") continue;
    ++reduced;
    EXPECT_EQ(separation["speed_scale"], least);
    EXPECT_TRUE(separation["link"].is_string());
  }
  EXPECT_GT(reduced, 1);
}

TEST(SeparationInScenes, TheTableTellsWhatEachLinkNeeds) {
  const OpenScene scene = open_scene(monitored_scene());
  SceneRun run(scene);
  ASSERT_TRUE(run.next());
  const std::string table = result_table(run.ask());
  EXPECT_NE(table.find("needs [m]  may go"), std::string::npos) << table;
  EXPECT_NE(table.find("%\n"), std::string::npos) << table;
}

TEST(SeparationInScenes, WithoutItNothingIsAdded) {
  SceneFile file = monitored_scene();
  file.separation.reset();
  const OpenScene scene = open_scene(file);
  SceneRun run(scene);
  ASSERT_TRUE(run.next());
  const Result result = run.ask();
  EXPECT_FALSE(Json::parse(result_json(result)).contains("separation"));
  EXPECT_EQ(result_table(result).find("may go"), std::string::npos);
}

TEST(SeparationInScenes, BadSettingsNameTheFile) {
  SceneFile file = monitored_scene();
  file.separation->stopping = {{1, 0.2, 0.1}, {0.5, 0.3, 0.2}};
  expect_parts(error_message([&] { open_scene(file); }),
               {"scene.yaml", "separation.stopping[1].speed_m_s", "0.5", "above 1"});
  file = monitored_scene();
  file.evaluation.visibility = false;
  const OpenScene scene = open_scene(file);
  expect_parts(error_message([&] { SceneRun run(scene); }), {"scene.yaml", "visibility is off"});
}

/// A result of two links with this in it.
struct Told {
  Result result;

  Told(SeparationState state, SeparationReason reason, double scale = 0) {
    result.links.resize(2);
    result.links[0].link = "base";
    result.links[1].link = "hand";
    result.links[1].visibility.surface.seen = 0.59F;
    result.cameras.resize(1);
    result.cameras[0].camera = "left";
    result.cameras[0].status = CameraStatus::too_old;
    result.cameras[0].age_s = 0.3;
    result.time = {TimeStatus::stale_frame, 0.2};
    Separation& separation = result.separation.emplace();
    separation.state = state;
    separation.reason = reason;
    separation.speed_scale = scale;
    separation.link = 2;
    separation.camera = 0;
    separation.links.resize(2);
    separation.links[1] = {2, true, 0.614, 0.3107, 0.5231, -0.2124, scale, reason};
  }
  std::string text() const { return separation_text(result); }
};

TEST(StatusText, NamesTheCause) {
  Result result;
  result.time = {TimeStatus::stale_joints, 0.1, 0.3104};
  EXPECT_EQ(status_text(result), "stale: the joint states are 0.310 s old");
  for (int i = 1; i < kTimeStatusCount; ++i) {
    result.time.status = static_cast<TimeStatus>(i);
    EXPECT_GT(status_text(result).size(), std::string("stale: ").size()) << i;
  }
  result.status = ResultStatus::ok;
  EXPECT_EQ(status_text(result), "ok");
  result.status = ResultStatus::degraded;
  result.cameras.resize(3);
  result.cameras[0].status = CameraStatus::hidden;
  result.cameras[1].camera = "left";
  result.cameras[1].status = CameraStatus::too_old;
  result.cameras[1].age_s = 0.42;
  result.cameras[2].camera = "top";
  result.cameras[2].status = CameraStatus::stale;
  result.cameras[2].time = TimeStatus::skewed;
  EXPECT_EQ(status_text(result),
            "degraded: camera left is too_old (0.42 s), camera top is stale (skewed)");
}

TEST(SeparationText, SaysWhatAndWhy) {
  using enum SeparationState;
  using R = SeparationReason;
  EXPECT_EQ(Told(clear, R::none, 1).text(), "clear");
  EXPECT_EQ(
      Told(reduced, R::occupied, 0.429).text(),
      "reduced to 42 %: hand is 0.310 m from what a camera sees; at 0.61 m/s it needs 0.523 m");
  EXPECT_EQ(Told(stop, R::unknown).text(),
            "stop: hand is 0.310 m from space that no camera sees; at 0.61 m/s it needs 0.523 m");
  EXPECT_NE(Told(stop, R::rejected).text().find("dropped as rejected"), std::string::npos);
  EXPECT_NE(Told(reduced, R::range).text().find("the end of the range"), std::string::npos);
  EXPECT_NE(Told(reduced, R::cut_short).text().find("the deadline"), std::string::npos);
  EXPECT_EQ(Told(stop, R::not_seen).text(), "stop: hand is 41 % unseen");
  EXPECT_EQ(Told(stop, R::camera).text(), "stop: camera left is too_old (0.30 s)");
  EXPECT_EQ(Told(stop, R::stale).text(), "stop: stale: the newest image is 0.200 s old");
  EXPECT_EQ(Told(stop, R::velocity).text(), "stop: the robot's velocity is not known");
  EXPECT_EQ(Told(SeparationState::reduced, R::speeding_up, 0.31).text(),
            "reduced to 31 %: there is room, and the robot gains speed");
  EXPECT_EQ(Told(SeparationState::contact_speed, R::camera, 0.25).text().substr(0, 50),
            "reduced to 25 %, the speed of a tolerable contact:");
  Told unknown(stop, R::not_seen);
  unknown.result.links[1].visibility.surface.seen = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(unknown.text(), "stop: hand is not seen");
}

}  // namespace
}  // namespace berth
