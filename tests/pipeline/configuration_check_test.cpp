// Verdicts on many configurations of the bundled arm, against the exact search.
#include "berth/pipeline/configuration_check.hpp"

#include "berth/distance/known_distances.hpp"
#include "berth/robot/primitives.hpp"
#include "sim/random.hpp"
#include "tests/pipeline/prepared_scene.hpp"
#include "tests/support/known_arms.hpp"
#include "tests/support/thinned.hpp"

namespace berth {
namespace {

using Verdicts = std::vector<Verdict>;
using Numbers = std::vector<double>;

class Configurations : public PreparedScene {
 protected:
  /// Half of them anywhere within the limits, half near where the arm is.
  Numbers draw(std::size_t count, sim::Random& random) const {
    Numbers out;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < robot()->model().joints.size(); ++j) {
        const MovableJoint& joint = robot()->model().joints[j];
        out.push_back(i % 2 == 0 ? random(joint.lower, joint.upper)
                                 : joints(3).position[j] + random(-0.4, 0.4));
      }
    }
    return out;
  }
  JointState at(const Numbers& positions, std::size_t i) const {
    const auto first = positions.begin() + static_cast<std::ptrdiff_t>(7 * i);
    return {0, {first, first + 7}};
  }
  static std::size_t count(const Verdicts& verdicts, Verdict which) {
    return static_cast<std::size_t>(std::ranges::count(verdicts, which));
  }
};

/// Of the moved links the least upper and lower bound.
struct Nearest {
  double distance_m = std::numeric_limits<double>::infinity();
  double lower_bound_m = std::numeric_limits<double>::infinity();
};

void expect_holds(Verdict verdict, const Nearest& exact, double margin_m) {
  if (verdict == Verdict::free) {
    EXPECT_GT(exact.distance_m, margin_m);
  }
  if (verdict == Verdict::near) {
    EXPECT_LE(exact.lower_bound_m, margin_m);
  }
}

Nearest nearest_of(const Result& result, const std::vector<std::string>& without = {}) {
  Nearest out;
  for (const LinkResult& link : result.links) {
    if (!link.is_moved || std::ranges::find(without, link.link) != without.end()) continue;
    out.distance_m = std::fmin(out.distance_m, link.distance_m);
    out.lower_bound_m = std::fmin(out.lower_bound_m, link.lower_bound_m);
  }
  return out;
}

TEST_F(Configurations, VerdictsAreThoseOfTheExactSearch) {
  constexpr std::size_t kCount = 160;
  ConfigurationCheck check(robot());
  Query query(robot());
  sim::Random random(1);
  for (const std::size_t cameras : {1U, 3U}) {
    SharedFrames frames = observe_all(3);
    frames.resize(cameras);
    ASSERT_EQ(check.prepare(frames), ResultStatus::ok);
    const Numbers positions = draw(thinned(kCount), random);
    std::vector<Nearest> exact;
    for (std::size_t i = 0; i < positions.size() / 7; ++i) {
      exact.push_back(nearest_of(query.ask({.frames = frames, .joints = at(positions, i)})));
    }
    for (const double margin_m : {0.01, 0.03, 0.1}) {
      Verdicts verdicts(exact.size());
      check.ask(positions, {.margin_m = margin_m}, verdicts);
      for (std::size_t i = 0; i < exact.size(); ++i) {
        expect_holds(verdicts[i], exact[i], margin_m);
      }
      const std::size_t many = 4000;
      Verdicts all(many);
      check.ask(draw(many, random), {.margin_m = margin_m}, all);
      EXPECT_LT(count(all, Verdict::undecided), many / 8);
      EXPECT_GT(count(all, Verdict::near), many / 40);
      if (margin_m < 0.05) {
        EXPECT_GT(count(all, Verdict::free), many / 2);
      }
      check.resolve(positions, {.margin_m = margin_m}, verdicts);
      for (std::size_t i = 0; i < exact.size(); ++i) {
        expect_holds(verdicts[i], exact[i], margin_m);
        if (verdicts[i] == Verdict::undecided) {
          EXPECT_NEAR(exact[i].distance_m, margin_m, 2e-3);
        }
      }
    }
  }
}

TEST_F(Configurations, ResolveGoesAsFarAsTheMarginWhateverARequestMay) {
  EvaluationSettings settings = robot()->settings();
  settings.distance.range_m = 0.01;
  settings.distance.deadline_us = 1;
  const SharedFrames frames = observe_all(3);
  ConfigurationCheck check(with_settings(robot(), settings));
  check.prepare(frames);
  sim::Random random(4);
  const Numbers positions = draw(20, random);
  Verdicts verdicts(20, Verdict::undecided);
  check.resolve(positions, {}, verdicts);
  EXPECT_LE(count(verdicts, Verdict::undecided), 1U);
}

TEST_F(Configurations, AMotionIsFreeWhereEachOfItsConfigurationsIs) {
  const SharedFrames frames = observe_all(3);
  ConfigurationCheck check(robot());
  check.prepare(frames);
  Query query(robot());
  sim::Random random(2);
  const std::size_t motions = thinned(200u);
  const Numbers from = draw(motions, random);
  Numbers to = from;
  for (double& q : to) q += random(-0.3, 0.3);
  Verdicts verdicts(motions);
  check.ask_motions(from, to, {}, verdicts);
  for (std::size_t i = 0; i < motions; ++i) {
    if (verdicts[i] != Verdict::free) continue;
    constexpr int kSteps = 8;
    for (int k = 0; k <= kSteps; ++k) {
      JointState joints = at(from, i);
      for (std::size_t j = 0; j < 7; ++j) {
        joints.position[j] += (to[7 * i + j] - joints.position[j]) * k / kSteps;
      }
      EXPECT_GT(nearest_of(query.ask({.frames = frames, .joints = joints})).distance_m, 0.03);
    }
  }
  const std::size_t many = 500;
  const Numbers here = draw(many, random), there = draw(many, random);
  Verdicts all(many);
  check.ask_motions(here, there, {}, all);
  EXPECT_GT(count(all, Verdict::free), many / 4);
  EXPECT_GT(count(all, Verdict::near), many / 20);
  // A motion that goes nowhere is a configuration.
  Verdicts still(motions), alone(motions);
  check.ask_motions(from, from, {}, still);
  check.ask(from, {}, alone);
  EXPECT_EQ(still, alone);
}

TEST_F(Configurations, EachLinkMayHaveAMarginOfItsOwnOrNone) {
  const SharedFrames frames = observe_all(3);
  ConfigurationCheck check(robot());
  check.prepare(frames);
  sim::Random random(3);
  const Numbers positions = draw(400, random);
  const auto ask = [&](const ConfigurationMargins& margins) {
    Verdicts verdicts(400);
    check.ask(positions, margins, verdicts);
    return verdicts;
  };
  std::vector<std::string> moved;
  for (const std::size_t link : robot()->model().evaluated_links) {
    if (robot()->model().is_moved(link)) moved.push_back(robot()->model().links[link].name);
  }
  EXPECT_EQ(count(ask({.without = moved}), Verdict::free), 400U);
  ConfigurationMargins wide{.margin_m = 0};
  for (const std::string& name : moved) wide.of_links.emplace_back(name, 0.03);
  EXPECT_EQ(ask(wide), ask({.margin_m = 0.03}));
  EXPECT_GT(count(ask({.margin_m = 0.01}), Verdict::free), count(ask({}), Verdict::free));
  const std::vector<std::string> hand{moved.end() - 2, moved.end()};
  EXPECT_GT(count(ask({.without = hand}), Verdict::free), count(ask({}), Verdict::free));
}

TEST_F(Configurations, TableOwnBodyAndOtherRobotsCountWhereTheyAreAskedAbout) {
  RobotSettings settings = bundled_arm();
  settings.others = two_arms_in_two().others;
  settings.environment_links = two_arms_in_two().environment_links;
  for (const RobotSettings& of : {bundled_arm(), settings}) {
    const auto arms = std::make_shared<const Robot>(load_robot(of));
    const std::size_t joints = arms->model().joints.size();
    // One camera that looks away: what it sees is not asked about.
    CameraMount mount{{64, 48, 50, 50, 31.5, 23.5}, arms->model().links.front().name};
    mount.X_PC = Pose(Eigen::Translation3d(0, 0, 30));
    Frame frame;
    Observer(std::make_shared<const MountedCamera>(arms, mount, CameraSettings()))
        .observe(DepthImage(64, 48, 2), JointState{0, Numbers(joints)}, frame);
    ConfigurationCheck check(arms);
    check.prepare(frame);
    ConfigurationMargins margins{.known_margin_m = 0.02};
    for (const std::size_t link : arms->model().evaluated_links) {
      margins.without.push_back(arms->model().links[link].name);
    }
    sim::Random random(5);
    const std::size_t count = thinned(200u);
    Numbers positions;
    for (std::size_t i = 0; i < count; ++i) {
      for (const MovableJoint& joint : arms->model().joints) {
        positions.push_back(random(joint.lower, joint.upper));
      }
    }
    Verdicts verdicts(count);
    check.ask(positions, margins, verdicts);
    KnownWorkspace workspace;
    std::vector<KnownPair> pairs;
    const auto nearest_at = [&](const Numbers& position) {
      RobotPose pose;
      forward_kinematics(arms->model(), position, pose);
      // Nobody asks how far what is farther away is.
      known_distances(arms->known(), pose, {.range_m = 0.05}, workspace, pairs);
      Nearest nearest;
      for (const KnownPair& pair : pairs) {
        nearest.distance_m = std::fmin(nearest.distance_m, pair.distance_m);
        nearest.lower_bound_m = std::fmin(nearest.lower_bound_m, pair.lower_bound_m);
      }
      return nearest;
    };
    const auto configuration = [&](std::size_t i) {
      const auto first = positions.begin() + static_cast<std::ptrdiff_t>(joints * i);
      return Numbers(first, first + static_cast<std::ptrdiff_t>(joints));
    };
    for (std::size_t i = 0; i < count; ++i) {
      const Nearest exact = nearest_at(configuration(i));
      expect_holds(verdicts[i], exact, 0.02);
    }
    EXPECT_GT(this->count(verdicts, Verdict::free), count / 10);
    EXPECT_GT(this->count(verdicts, Verdict::near), count / 20);
    EXPECT_LT(this->count(verdicts, Verdict::undecided), count / 5);
    check.resolve(positions, margins, verdicts);
    for (std::size_t i = 0; i < count; ++i) {
      if (verdicts[i] != Verdict::undecided) continue;
      EXPECT_NEAR(nearest_at(configuration(i)).distance_m, 0.02, 2e-3);
    }
    // Motions from free ones.
    Numbers from, to;
    for (std::size_t i = 0; i < count; ++i) {
      const Numbers at = configuration(i);
      for (const double q : at) {
        from.push_back(q);
        to.push_back(q + random(-0.2, 0.2));
      }
    }
    check.ask_motions(from, to, margins, verdicts);
    int free = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (verdicts[i] != Verdict::free) continue;
      ++free;
      for (int k = 0; k <= 5; ++k) {
        Numbers at = configuration(i);
        for (std::size_t j = 0; j < joints; ++j) at[j] += (to[joints * i + j] - at[j]) * k / 5;
        EXPECT_GT(nearest_at(at).distance_m, 0.02);
      }
    }
    EXPECT_GT(free, static_cast<int>(count / 20));
  }
}

TEST_F(Configurations, ManyThreadsMayAsk) {
  const SharedFrames frames = observe_all(3);
  ConfigurationCheck check(robot());
  check.prepare(frames);
  sim::Random random(6);
  const std::size_t count = thinned(2000u);
  const Numbers positions = draw(count, random);
  const ConfigurationMargins margins{.known_margin_m = 0.01};
  std::array<Verdicts, 3> found;
  {
    std::vector<std::jthread> threads;
    for (Verdicts& verdicts : found) {
      verdicts.resize(count);
      threads.emplace_back([&] { check.ask(positions, margins, verdicts); });
    }
  }
  for (const Verdicts& verdicts : found) EXPECT_EQ(verdicts, found[0]);
}

TEST_F(Configurations, WithoutAFrameNothingIsDecided) {
  ConfigurationCheck check(robot());
  Verdicts verdicts(1, Verdict::free);
  check.ask(joints(0).position, {}, verdicts);
  EXPECT_EQ(verdicts[0], Verdict::undecided);
  SharedFrames frames = observe_all(3);
  EXPECT_EQ(check.prepare(frames), ResultStatus::ok);
  check.ask(joints(0).position, {.margin_m = 0}, verdicts);
  EXPECT_NE(verdicts[0], Verdict::undecided);
  EXPECT_EQ(check.prepare(frames, frames[0]->stamp_s + 100), ResultStatus::stale);
  check.ask(joints(0).position, {.margin_m = 0}, verdicts);
  EXPECT_EQ(verdicts[0], Verdict::undecided);
  frames[1] = nullptr;
  EXPECT_EQ(check.prepare(frames), ResultStatus::degraded);
}

TEST_F(Configurations, WhatIsAttachedTakesPart) {
  const SharedFrames frames = observe_all(3);
  sim::Random random(4);
  const Numbers positions = draw(300, random);
  ConfigurationCheck bare(robot());
  bare.prepare(frames);
  Verdicts without(300), with(300);
  bare.ask(positions, {}, without);
  Attachment rod;
  rod.name = "rod";
  rod.link = robot()->model().links[robot()->model().evaluated_links.back()].name;
  rod.mesh_A = make_box(Eigen::Vector3d(0.02, 0.02, 0.6));
  const auto carrying = attach(*robot(), rod);
  ConfigurationCheck check(carrying);
  check.prepare(frames);
  check.ask(positions, {}, with);
  EXPECT_LT(count(with, Verdict::free), count(without, Verdict::free));
}

TEST_F(Configurations, BadQuestionsAreRefused) {
  ConfigurationCheck check(robot());
  Verdicts one(1);
  const auto message = [&](const Numbers& positions, const ConfigurationMargins& margins) {
    return error_message<std::invalid_argument>([&] { check.ask(positions, margins, one); });
  };
  EXPECT_EQ(message(Numbers(6), {}),
            "configurations: 6 numbers; expected 7 for 1 verdicts and 7 joints");
  Numbers bad(7);
  bad[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(bad, {}), "configurations: joint \"" + robot()->model().joints[2].name +
                                  "\" of configuration 0 is nan; expected a finite number");
  EXPECT_EQ(message(Numbers(7), {.margin_m = -1}),
            "configurations: a margin is -1 m; expected a finite number of at least 0");
  const ConfigurationMargins no_number{.known_margin_m = std::nan("")};
  EXPECT_EQ(message(Numbers(7), no_number),
            "configurations: a margin is nan m; expected a finite number of at least 0");
  EXPECT_EQ(
      error_message<std::invalid_argument>([&] { check.resolve(Numbers(7), no_number, one); }),
      "configurations: a margin is nan m; expected a finite number of at least 0");
  Numbers far(7);
  far[1] = -1e9;
  EXPECT_EQ(
      error_message<std::invalid_argument>([&] { check.ask_motions(Numbers(7), far, {}, one); }),
      "configurations: joint \"" + robot()->model().joints[1].name +
          "\" of motion 0 goes by -1000000000; expected at most 100");
  EXPECT_TRUE(message(Numbers(7), {.without = {"tail"}})
                  .starts_with("configurations: link \"tail\" is not known; expected one of "));
}

}  // namespace
}  // namespace berth
