#include "berth/scene/former_settings.hpp"

#include <gtest/gtest.h>

#include "berth/scene/scene_file.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

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
