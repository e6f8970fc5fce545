// The limits that are learnt, on the bundled scene: cameras that were bumped are found within a
// second, and no person raises an alarm. Thinned; all of it: build/release/lab/measure_bumped.
#include "lab/watch/bumped.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/data_folder.hpp"

namespace berth::lab {
namespace {

class Bumped : public testing::Test {
 protected:
  Bumped() : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml")) {}

  OpenScene scene_;
};

TEST_F(Bumped, NoFrameOfTheSceneWithItsPersonRaisesAnAlarm) {
  for (const OpenCamera& camera : scene_.cameras) {
    const SeenThroughs own = own_frames(camera);
    ASSERT_EQ(own.size(), camera.source.depth.size());
    for (const double seen_through : own) EXPECT_LT(seen_through, 0.01) << camera.source.name;
    WatchSettings each_frame = learned_limits(own, {});
    EXPECT_FALSE(is_alarm(own, each_frame));
    each_frame.agreeing_frames = each_frame.frames = 1;
    EXPECT_FALSE(is_alarm(own, each_frame)) << "nor would one frame alone";
  }
}

TEST_F(Bumped, ASecondIsEnoughWhereTSeesTheBump) {
  constexpr int kNth = 18;
  double by_2_deg = 0, by_5_cm = 0, by_2_cm = 0;
  for (const OpenCamera& camera : scene_.cameras) {
    const WatchSettings rule = learned_limits(own_frames(camera), {});
    const auto seconds = bumped_seconds(camera, {.angle_rad = 2 * std::numbers::pi / 180}, kNth);
    ASSERT_EQ(seconds.size(), 2U * kDirections);
    by_2_deg += alarm_share(seconds, rule) / 3;
    by_5_cm += alarm_share(bumped_seconds(camera, {.offset_m = 0.05}, kNth), rule) / 3;
    by_2_cm += alarm_share(bumped_seconds(camera, {.offset_m = 0.02}, kNth), rule) / 3;
    EXPECT_EQ(alarm_share(bumped_seconds(camera, {}, kNth), rule), 0) << "not bumped, noise alone";
  }
  // T does not see what goes along the line of sight; D does.
  EXPECT_GE(by_2_deg, 0.85);
  EXPECT_GE(by_5_cm, 0.85);
  EXPECT_GE(by_2_cm, 0.55);
  RecordProperty("share_of_2_cm", std::to_string(by_2_cm));
}

TEST_F(Bumped, NobodyWhoHidesTheArmRaisesAnAlarm) {
  for (const OpenCamera& camera : scene_.cameras) {
    WatchSettings each_frame = learned_limits(own_frames(camera), {});
    each_frame.agreeing_frames = each_frame.frames = 1;
    const auto seconds = hidden_seconds(camera, 4);
    EXPECT_EQ(alarm_share(seconds, each_frame), 0) << camera.source.name;
  }
}

/// Their poses are given, not calibrated: normal is 1 to 13 % there.
TEST(BumpedRecordings, TheirOwnFramesRaiseNoAlarm) {
  for (const char* name : {"lbr_med7_zed2i", "xarm7_realsense"}) {
    const std::filesystem::path file = data_folder() / "recordings" / name / "scene.yaml";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs the recordings";
    const OpenScene scene = open_scene(file);
    const SeenThroughs own = own_frames(scene.cameras.front());
    for (const double seen_through : own) EXPECT_LT(seen_through, 0.15) << name;
    EXPECT_FALSE(is_alarm(own, learned_limits(own, {})));
  }
}

}  // namespace
}  // namespace berth::lab
