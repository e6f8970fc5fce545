// The method `mesh` against true distances of whole links; berth_trust --whole-robot runs more.
#include <gtest/gtest.h>

#include <limits>

#include "lab/trust/trial_robots.hpp"
#include "lab/trust/whole_robot_tables.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/thinned.hpp"

namespace berth::lab {
namespace {

constexpr sim::DrawnSceneSettings kViewImages{.width_px = 224, .height_px = 172};
constexpr std::size_t kThreeCameras = 2;

/// Seeds 0 to scenes - 1, on clean images. What no image shows is not judged: no camera can tell
/// it.
int expect_within_bound(const TrialRobot& robot, int scenes) {
  const std::vector<WholeRobotCondition> clean = {{"clean"}};
  int checked = 0;
  for (int seed = 0; seed < scenes; ++seed) {
    const WholeRobotTrial trial =
        run_whole_robot_trial(robot, kViewImages, static_cast<std::uint32_t>(seed), clean);
    for (std::size_t i = 0; i < trial.truth.size(); ++i) {
      if (trial.truth[i].sight[kThreeCameras] != sim::ObstacleSight::covered) continue;
      const double most_m = trial.truth[i].distance_m + kMaxWholeRobotOverestimate_m;
      if (most_m > kTrialRange_m) continue;
      EXPECT_LE(trial.under[0].mesh[kThreeCameras][i].nearest_m, most_m)
          << robot.name << ", seed " << seed << ", link " << i + 1;
      ++checked;
    }
  }
  return checked;
}

TEST(WholeRobotTrust,
     WithThreeCamerasNoDistanceOfTheBundledArmIsAboveTheTrueOneByMoreThanTheBound) {
  EXPECT_GT(expect_within_bound(load_bundled_robot(), thinned(8)), thinned(30));
}

TEST(WholeRobotTrust, WithThreeCamerasNoDistanceOfARealRobotIsAboveTheTrueOneByMoreThanTheBound) {
  const std::filesystem::path folder = data_folder() / "robots";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no robots in " << folder;
  int checked = 0;
  std::vector<TrialRobot> robots = load_trial_robots(folder);
  robots.erase(robots.begin());
  for (const TrialRobot& robot : robots) checked += expect_within_bound(robot, 1);
  EXPECT_GT(checked, 4 * static_cast<int>(robots.size()));
}

/// One link, and what is said of it with one to four cameras.
WholeRobotTrial made_up_trial(const TrialRobot& robot, double true_m, double nearest_m) {
  const std::vector<WholeRobotEstimate> said = {{nearest_m, nearest_m}};
  constexpr auto kCovered = sim::ObstacleSight::covered;
  constexpr auto kOutside = sim::ObstacleSight::outside;
  return {&robot,
          7,
          {{true_m, {kOutside, kOutside, kCovered, kCovered}}},
          {{{said, said, said, said}, {{LinkStatus::ok, nearest_m}}}}};
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
  const std::string by_sight = whole_robot_sight_table(trials, 0);
  EXPECT_NE(by_sight.find("| 2 cameras, seen or hidden: outside of all images | 5 | 40.0 % |"),
            std::string::npos)
      << by_sight;
  EXPECT_NE(by_sight.find("| 3 cameras, seen or hidden: in an image | 5 | 40.0 % |"),
            std::string::npos)
      << by_sight;
  EXPECT_NE(by_sight.find("| 3 cameras, seen or hidden: outside of all images | 0 |"),
            std::string::npos)
      << by_sight;
  EXPECT_NE(worst_whole_robot_table(trials, 0, 1).find("| 900.0 | 100.0 |"), std::string::npos);
}

}  // namespace
}  // namespace berth::lab
