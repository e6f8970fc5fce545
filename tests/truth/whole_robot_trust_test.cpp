// The method `mesh` against true distances of whole links; measure_trust --whole-robot runs more.
#include <gtest/gtest.h>

#include <limits>

#include "lab/trust/trial_robots.hpp"
#include "lab/trust/whole_robot_tables.hpp"

namespace berth::lab {
namespace {

constexpr testing::DrawnSceneSettings kImage{.width_px = 320, .height_px = 240};
constexpr std::size_t kThreeCameras = 2;

TEST(WholeRobotTrust, WithThreeCamerasNoDistanceIsAboveTheTrueOneByMoreThanTheBound) {
  const TrialRobot robot = load_bundled_robot();
  const std::vector<WholeRobotCondition> clean = {{"clean"}};
  int checked = 0;
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    const WholeRobotTrial trial = run_whole_robot_trial(robot, kImage, seed, clean);
    for (std::size_t i = 0; i < trial.true_m.size(); ++i) {
      const double most_m = trial.true_m[i] + kMaxWholeRobotOverestimate_m;
      if (most_m > kTrialRange_m) continue;
      EXPECT_LE(trial.under[0].mesh[kThreeCameras][i].nearest_m, most_m)
          << "seed " << seed << ", link " << i + 1;
      ++checked;
    }
  }
  EXPECT_GT(checked, 40);
}

/// One link, and what is said of it with one to four cameras.
WholeRobotTrial made_up_trial(const TrialRobot& robot, double true_m, double nearest_m) {
  const std::vector<WholeRobotEstimate> said = {{nearest_m, nearest_m}};
  return {&robot, 7, {true_m}, {{{said, said, said, said}, {{LinkStatus::ok, nearest_m}}}}};
}

TEST(WholeRobotTables, TellTooLargeFromTooSmallAndZeros) {
  TrialRobot robot;
  robot.model.links.resize(1);
  robot.model.evaluated_links = {0};
  const double none = std::numeric_limits<double>::infinity();
  const std::vector<WholeRobotTrial> trials = {
      made_up_trial(robot, 0.20, 0.21), made_up_trial(robot, 0.30, 0.25),
      made_up_trial(robot, 0.30, 0), made_up_trial(robot, 0.90, none),
      made_up_trial(robot, 1.50, none)};
  const std::string text = whole_robot_table(trials, {{"name"}});
  EXPECT_NE(text.find("| `mesh`, seen or hidden, 3 cameras | 5 | 40.0 % | 10.0 | 100.0 | 100.0 | "
                      "40.0 % | 50.0 | 20.0 % | 1 |"),
            std::string::npos)
      << text;
  EXPECT_NE(worst_whole_robot_table(trials, 0, 1).find("| 900.0 | 100.0 |"), std::string::npos);
}

}  // namespace
}  // namespace berth::lab
