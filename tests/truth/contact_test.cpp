// What touches the robot, or gives no reading, is told; berth_trust --contact runs more.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

#include "lab/trust/contact_trial.hpp"
#include "lab/trust/trial_robots.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/thinned.hpp"

namespace berth::lab {
namespace {

constexpr double kMostTooFar_m = 0.04;
constexpr double kMostTooFarFromBlack_m = 0.05;

/// With BERTH_CONTACT=full ten times as many.
int scenes_of(int thin) {
  const char* size = std::getenv("BERTH_CONTACT");
  return size && std::string_view(size) == "full" ? 10 * thin : thinned(thin);
}

std::vector<TrialRobot> some_robots() {
  std::vector<TrialRobot> robots;
  const std::filesystem::path folder = data_folder() / "robots";
  robots.push_back(load_bundled_robot());
  for (const char* urdf : {"kuka_lbr_med7/lbr_med7.urdf", "xarm7/xarm7_with_gripper.urdf"}) {
    if (!std::filesystem::exists(folder / urdf)) continue;
    robots.push_back(make_trial_robot(urdf, load_robot({.urdf = folder / urdf})));
  }
  return robots;
}

/// Two and three cameras in turn: one alone takes what is close behind the robot's outline for
/// free. How many links were judged.
int expect_told(const ContactCase& of, int scenes, double most_m) {
  static const std::vector<TrialRobot> robots = some_robots();
  int judged = 0;
  for (int seed = 0; seed < scenes; ++seed) {
    ContactCase one = of;
    one.scene.width_px = 424;
    one.scene.height_px = 320;
    one.scene.cameras = 2 + seed % 2;
    const ContactTrial trial =
        run_contact_trial(robots[seed / 2 % robots.size()], one, static_cast<std::uint32_t>(seed));
    if (trial.is_assumed_away) continue;
    for (std::size_t i = 0; i < trial.links.size(); ++i) {
      if (!trial.links[i].is_told || !trial.links[i].is_covered) continue;
      ++judged;
      EXPECT_LE(trial.links[i].too_far_m(), most_m)
          << trial.robot << ", seed " << seed << ", link " << i + 1 << ", truly "
          << trial.links[i].truth_m << " m";
    }
  }
  return judged;
}

TEST(Contact, ABoxThatTouchesTheArmIsToldWithinFourCentimetres) {
  const int scenes = scenes_of(6);
  EXPECT_GT(expect_told({{.kind = sim::ContactKind::box_at_arm}}, scenes, kMostTooFar_m), scenes);
}

TEST(Contact, AHandThatLiesOnTheArmIsToldWithinFourCentimetres) {
  const int scenes = scenes_of(6);
  EXPECT_GT(expect_told({{.kind = sim::ContactKind::hand_on_arm}}, scenes, kMostTooFar_m), scenes);
}

TEST(Contact, AHandOnTheTableBelowALinkIsToldWithinFourCentimetres) {
  const int scenes = scenes_of(6);
  EXPECT_GT(expect_told({{.kind = sim::ContactKind::hand_on_table}}, scenes, kMostTooFar_m),
            scenes);
}

TEST(Contact, WhatGivesNoReadingIsToldToTwoCamerasThatKnowTheCell) {
  const int scenes = scenes_of(6);
  EXPECT_GT(expect_told({{.kind = sim::ContactKind::black}, ContactImages::clean, true}, scenes,
                        kMostTooFarFromBlack_m),
            scenes);
}

TEST(Contact, TheSensorModelLosesNoBoxAtTheArm) {
  const int scenes = scenes_of(6);
  EXPECT_GT(expect_told({{.kind = sim::ContactKind::box_at_arm}, ContactImages::sensor_model},
                        scenes, kMostTooFar_m),
            scenes);
}

}  // namespace
}  // namespace berth::lab
