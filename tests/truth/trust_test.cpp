// berth's distances against the true ones; lab/trust runs a thousand scenes of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lab/trust/real_image.hpp"
#include "lab/trust/tables.hpp"
#include "lab/trust/trial_robots.hpp"
#include "tests/support/data_folder.hpp"

namespace berth::lab {
namespace {

constexpr sim::DrawnSceneSettings kImage{.width_px = 320, .height_px = 240};
const Condition kDistanceAlone{"test", "clean", {}, {}, MeasuredFilter::ideal};

/// Seeds 0 to scenes - 1 of each robot.
std::vector<Trial> run_trials(const std::vector<TrialRobot>& robots, int scenes) {
  std::vector<Trial> trials;
  for (const TrialRobot& robot : robots) {
    for (int seed = 0; seed < scenes; ++seed) {
      trials.push_back(run_trial(robot, kImage, seed, {kDistanceAlone}));
    }
  }
  return trials;
}

void expect_within_bound(const std::vector<Trial>& trials) {
  int checked = 0;
  for (const Trial& trial : trials) {
    for (std::size_t i = 0; i < trial.truth.size(); ++i) {
      const sim::TrueDistance& truth = trial.truth[i];
      const Estimate& estimate = trial.estimates[0][i];
      if (truth.sight != sim::ObstacleSight::covered) continue;
      const double most_m = truth.seen_C.distance_m + sim::max_overestimate_m(trial.camera, truth);
      if (most_m > kTrialRange_m) continue;
      EXPECT_EQ(estimate.status, LinkStatus::ok)
          << trial.robot->name << ", seed " << trial.seed << ", link " << i + 1;
      EXPECT_LE(estimate.distance_m, most_m)
          << trial.robot->name << ", seed " << trial.seed << ", link " << i + 1;
      ++checked;
    }
  }
  EXPECT_GT(checked, 4 * static_cast<int>(trials.size()));
}

TEST(Trust, NoDistanceOfTheBundledArmIsAboveTheTrueOneByMoreThanTheBound) {
  std::vector<TrialRobot> robots;
  robots.push_back(load_bundled_robot());
  expect_within_bound(run_trials(robots, 12));
}

TEST(Trust, NoDistanceOfARealRobotIsAboveTheTrueOneByMoreThanTheBound) {
  const std::filesystem::path folder = data_folder() / "robots";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no robots in " << folder;
  std::vector<TrialRobot> robots = load_trial_robots(folder);
  robots.erase(robots.begin());
  expect_within_bound(run_trials(robots, 1));
}

/// A scene in which the visible rest of a thing is small and near the robot.
struct RimScene {
  const char* robot;
  std::uint32_t seed;
  int width_px;
  int height_px;
};

/// The rule for flying patches keeps the distances that there are without it.
void expect_rims_kept(const std::vector<TrialRobot>& robots, const std::vector<RimScene>& scenes) {
  Condition defaults{"test", "defaults"};
  Condition no_flying_patches = defaults;
  no_flying_patches.self_filter.flying_patch_radius_m = 0;
  for (const RimScene& scene : scenes) {
    const auto robot = std::find_if(robots.begin(), robots.end(),
                                    [&](const TrialRobot& r) { return r.name == scene.robot; });
    ASSERT_NE(robot, robots.end()) << scene.robot;
    const Trial trial =
        run_trial(*robot, {.width_px = scene.width_px, .height_px = scene.height_px}, scene.seed,
                  {defaults, no_flying_patches});
    int checked = 0;
    for (std::size_t i = 0; i < trial.truth.size(); ++i) {
      if (trial.truth[i].sight != sim::ObstacleSight::covered) continue;
      EXPECT_LE(trial.estimates[0][i].distance_m, trial.estimates[1][i].distance_m + 0.001)
          << scene.robot << ", seed " << scene.seed << ", link " << i + 1;
      ++checked;
    }
    EXPECT_GE(checked, 2) << scene.robot << ", seed " << scene.seed;
  }
}

TEST(Trust, ARimBesideTheBundledArmKeepsItsDistance) {
  std::vector<TrialRobot> robots;
  robots.push_back(load_bundled_robot());
  expect_rims_kept(robots, {{"bundled arm", 497, 640, 480}});
}

TEST(Trust, ARimBesideARealRobotKeepsItsDistance) {
  const std::filesystem::path folder = data_folder() / "robots";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no robots in " << folder;
  expect_rims_kept(load_trial_robots(folder), {{"xarm7/xarm7_with_gripper", 129, 224, 172},
                                               {"widowx/widowx", 58, 320, 240},
                                               {"widowx/widowx", 816, 224, 172}});
}

/// Nothing is hidden in silence: what a rule drops beside the arm, where there is no padding, is
/// told as rejected.
TEST(Trust, InRealDepthImagesTheRejectedDistanceLosesNothing) {
  const std::filesystem::path data = data_folder();
  if (!std::filesystem::is_directory(data / "depth")) GTEST_SKIP() << "no images in " << data;
  const std::vector<RealImage> images = load_real_images(data / "depth");
  const std::vector<TrialRobot> robots = load_trial_robots(data / "robots");
  RealImageRules rules;
  rules.self_filter.padding_m = 0;
  rules.sensor.speckle_px = 60;
  rules.counts_rejected = true;
  RealImageRules in_silence = rules;
  in_silence.counts_rejected = false;
  int checked = 0, farther_in_silence = 0;
  for (int i = 0; i < 120; ++i) {
    const RealImage& image = images[i % images.size()];
    const TrialRobot& robot = robots[i / images.size() % robots.size()];
    const auto scene = draw_into(image, robot, static_cast<std::uint32_t>(i));
    if (!scene) continue;
    const std::vector<Estimate> estimates = estimate(*scene, rules);
    const std::vector<Estimate> silent = estimate(*scene, in_silence);
    for (std::size_t link = 0; link < estimates.size(); ++link) {
      if (scene->ideal.links[link].status != LinkStatus::ok) continue;
      const double ideal_m = scene->ideal.links[link].distance_m;
      ASSERT_EQ(estimates[link].status, LinkStatus::ok) << image.name << ", seed " << i;
      EXPECT_LE(estimates[link].distance_m, ideal_m + 1e-5) << image.name << ", seed " << i;
      farther_in_silence +=
          silent[link].status != LinkStatus::ok || silent[link].distance_m > ideal_m + 1e-5;
      ++checked;
    }
  }
  EXPECT_GT(checked, 300);
  EXPECT_GT(farther_in_silence, 0) << "the rules drop nothing here";
}

TEST(Trust, EveryConditionIsMeasuredOnceInItsTable) {
  std::set<std::string> names;
  for (const Condition& condition : all_conditions()) {
    EXPECT_TRUE(names.insert(condition.table + condition.name).second) << condition.name;
  }
  const std::size_t first = first_of_pipeline(all_conditions());
  EXPECT_EQ(all_conditions()[first].image, sim::SensorErrors{});
  EXPECT_EQ(all_conditions()[first].filter, MeasuredFilter::berth);
}

TEST(Trust, ATrialDependsOnItsSeedAloneAndItsErrorsReachTheImage) {
  const TrialRobot robot = load_bundled_robot();
  const Condition noisy{"test", "noise", {.noise_m_at_1m = 0.005}, {}, MeasuredFilter::ideal};
  const Condition late{"test", "late", {}, {.delay_s = 0.05}, MeasuredFilter::ideal};
  const sim::DrawnSceneSettings small{.width_px = 160, .height_px = 120};
  const auto distances = [&](const Trial& trial, std::size_t condition) {
    std::vector<double> distances_m;
    for (const Estimate& e : trial.estimates[condition]) {
      if (e.status == LinkStatus::ok) distances_m.push_back(e.distance_m);
    }
    return distances_m;
  };
  const Trial trial = run_trial(robot, small, 3, {kDistanceAlone, noisy, late});
  const Trial again = run_trial(robot, small, 3, {kDistanceAlone, noisy, late});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(distances(trial, i), distances(again, i));
  EXPECT_NE(distances(trial, 0), distances(trial, 1));
  EXPECT_NE(distances(trial, 0), distances(trial, 2));
}

/// One link whose nearest obstacle is truly at true_m, and what berth says.
Trial made_up_trial(const TrialRobot& robot, double true_m, Estimate estimate) {
  sim::TrueDistance truth;
  truth.seen_C = {true_m, {0, 0, 1}, {true_m, 0, 1}};
  truth.whole_m = true_m;
  truth.sight = sim::ObstacleSight::covered;
  return {&robot, 7, {640, 480, 500, 500, 319.5, 239.5}, {truth}, {{estimate}}};
}

TEST(TrustTables, TellTooLargeFromTooSmallAndWhatWasLost) {
  TrialRobot robot;
  robot.model.links.resize(1);
  robot.model.evaluated_links = {0};
  const std::vector<Trial> trials = {made_up_trial(robot, 0.20, {LinkStatus::ok, 0.21}),
                                     made_up_trial(robot, 0.05, {LinkStatus::ok, 0.08}),
                                     made_up_trial(robot, 0.30, {LinkStatus::ok, 0.25}),
                                     made_up_trial(robot, 0.30, {LinkStatus::ok, 0.29}),
                                     made_up_trial(robot, 0.90, {LinkStatus::none_in_range, 0}),
                                     made_up_trial(robot, 1.50, {LinkStatus::none_in_range, 0})};
  const std::string text = condition_tables(trials, {{"Title", "name"}});
  EXPECT_NE(text.find("## Title\n"), std::string::npos) << text;
  EXPECT_NE(text.find("| name | 4 | 50.0 % | 10.0 | 30.0 | 30.0 | 10.0 | 50.0 % | 10.0 | 50.0 | "
                      "50.0 | 30.0 | 30.0 | 1 |"),
            std::string::npos)
      << text;
  EXPECT_NE(worst_table(trials, 0, 1).find("| 80.0 | 50.0 | 30.0 |"), std::string::npos);
}

}  // namespace
}  // namespace berth::lab
