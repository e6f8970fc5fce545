// An arm beside its table and another arm, with whatever velocities are wanted.
// BERTH_CONTROL_TWIN=full in the environment makes it a hundred times as many steps.
#include "berth/control/velocity_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/control/cases.hpp"
#include "tests/control/rows_robot.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

using Numbers = std::vector<double>;

/// The elbow up, nothing near.
const Numbers kFree{0.1, 0.5, 0.2, -1.3, 0.1, 1.0, 0.3};

Numbers draw(sim::Random& random, std::size_t count, double most) {
  Numbers out;
  for (std::size_t j = 0; j < count; ++j) out.push_back(random(-most, most));
  return out;
}

void go(Numbers& position, const Numbers& velocity, double time_s) {
  for (std::size_t j = 0; j < position.size(); ++j) position[j] += time_s * velocity[j];
}

class Filtered : public testing::Test {
 protected:
  const FilteredVelocity& update(VelocityFilter& filter, const Numbers& wanted,
                                 const Numbers& velocity = Numbers(7, 0)) {
    return filter.update(arm.result, {position, velocity, wanted});
  }
  /// What is nearer to the last link by so much more with each of these velocities.
  double approach_m_s(const VelocityFilter& filter, const Numbers& velocity) const {
    const Eigen::Map<const Eigen::VectorXd> v(velocity.data(), 7);
    return -filter.rows().gradient(RowKind::nearest).row(7).dot(v);
  }
  /// In front of the last link.
  void put_in_front(float distance_m) {
    arm.ask(position);
    const Pose& X_BL = arm.result.pose.X_BL[arm.model().evaluated_links[7]];
    put(arm, 7, {0, 0, 0.1}, X_BL * Eigen::Vector3d(distance_m, 0, 0.1), arm.result.links[7]);
  }

  /// 1 where joint 1 turns the last link towards what is in front of it, else -1.
  double sign_towards(VelocityFilter& filter) {
    const Numbers wanted{1, 0, 0, 0, 0, 0.5, 0};
    update(filter, wanted);
    return approach_m_s(filter, wanted) > 0 ? 1 : -1;
  }

  RowsRobot arm{bundled_arm()};
  Numbers position = kFree;
};

TEST_F(Filtered, WhatIsWantedStaysWhereNothingIsNear) {
  VelocityFilter filter(arm.robot, {});
  arm.ask(position);
  const Numbers wanted{0.1, 0.2, -0.1, 0.3, 0.2, -0.1, 0.5};
  const FilteredVelocity& out = update(filter, wanted);
  EXPECT_EQ(out.status, FilterStatus::ok);
  EXPECT_EQ(out.velocity, wanted);
  EXPECT_EQ(out.scale, 1);
  EXPECT_TRUE(out.held_by.empty());
}

TEST_F(Filtered, ItComesNearerNoFasterThanTheRowAllowsAndGoesOnBesideIt) {
  VelocityFilter filter(arm.robot, {});
  put_in_front(0.2F);
  const double sign = sign_towards(filter);
  const Numbers towards{sign, 0, 0, 0, 0, 0.5, 0}, away{-sign, 0, 0, 0, 0, 0.5, 0};
  const FilteredVelocity& out = update(filter, towards);
  const double allowed_m_s = 2 * (0.2 - 0.001 - 0.05);
  EXPECT_LE(approach_m_s(filter, out.velocity), allowed_m_s + 1e-6);
  EXPECT_GT(approach_m_s(filter, out.velocity), 0.5 * allowed_m_s);
  ASSERT_EQ(out.held_by.size(), 1U);
  EXPECT_EQ(out.held_by[0], (LinkRow{8, RowKind::nearest}));
  EXPECT_EQ(update(filter, away).velocity, away);
}

TEST_F(Filtered, TheCheckLeavesWhatWasSolvedWhileItComesNear) {
  VelocityFilter filter(arm.robot, {});
  put_in_front(0.15F);
  const Eigen::Vector3d obstacle_B_m = arm.result.links[7].obstacle_point_B_m.cast<double>();
  Numbers wanted{0.5, 0, 0, 0, 0, 0.5, 0};
  update(filter, wanted);
  if (approach_m_s(filter, wanted) < 0) wanted[0] = -0.5;
  double least_m = 1;
  for (int k = 0; k < 100; ++k) {
    arm.ask(position);
    put(arm, 7, {0, 0, 0.1}, obstacle_B_m, arm.result.links[7]);
    least_m = std::min<double>(least_m, arm.result.links[7].distance_m);
    const FilteredVelocity& out = update(filter, wanted);
    EXPECT_EQ(out.scale, 1) << k;
    go(position, out.velocity, 0.01);
  }
  EXPECT_LT(least_m, 0.14);
  EXPECT_GT(least_m, 0.05);
}

TEST_F(Filtered, NoOtherVelocityIsNearerToTheWantedOne) {
  VelocityFilter filter(arm.robot, {.latency_s = 0});
  sim::Random random(3);
  int held = 0;
  for (int k = 0; k < cases(20'000); ++k) {
    position = arm.draw_positions(random);
    // No limit of a joint is near.
    for (double& q : position) q *= 0.98;
    arm.ask(position);
    const Numbers wanted = draw(random, 7, 1);
    const FilteredVelocity& out = update(filter, wanted);
    if (out.scale < 1 || out.held_by.empty()) continue;
    ++held;
    const Eigen::Map<const Eigen::VectorXd> v(out.velocity.data(), 7), w(wanted.data(), 7);
    for (int i = 0; i < 50; ++i) {
      // On the straight line to any other velocity it gets farther away or breaks a row.
      const Numbers other = draw(random, 7, 1);
      const Eigen::VectorXd u = v + 1e-3 * (Eigen::Map<const Eigen::VectorXd>(other.data(), 7) - v);
      if ((u - w).norm() > (v - w).norm() - 1e-6) continue;
      const bool breaks_one = std::ranges::any_of(out.held_by, [&](const LinkRow& row) {
        const auto gradient = filter.rows().gradient(row.kind).row(row.link - 1);
        return gradient.dot(u) < gradient.dot(v);
      });
      EXPECT_TRUE(breaks_one);
    }
  }
  EXPECT_GT(held, cases(20'000) / 40);
}

/// Where two arms are after each step of drawn velocities, filtered or not.
struct Walk {
  double least_m = std::numeric_limits<double>::infinity();
  int shortened = 0;
  int moved = 0;
};

Walk walk(const VelocityFilterSettings& settings, int steps, bool is_filtered) {
  RowsRobot arms(two_arms_in_two());
  VelocityFilter filter(arms.robot, settings);
  sim::Random random(4);
  Numbers position(14, 0), velocity(14, 0), wanted(14, 0);
  for (std::size_t j = 0; j < 14; ++j) position[j] = kFree[j % 7];
  // Side by side.
  position[0] = position[7] = 1.5;
  Walk out;
  for (int k = 0; k < steps; ++k) {
    if (k % 50 == 0) wanted = draw(random, 14, 1.5);
    arms.ask(position);
    for (const LinkResult& link : arms.result.links) {
      if (link.known.is_known()) out.least_m = std::min<double>(out.least_m, link.known.distance_m);
    }
    const FilteredVelocity& found = filter.update(arms.result, {position, velocity, wanted});
    go(position, velocity, settings.latency_s);
    velocity = is_filtered ? found.velocity : wanted;
    out.shortened += found.status == FilterStatus::ok && found.scale < 1;
    out.moved += found.status == FilterStatus::ok && velocity != Numbers(14, 0);
    go(position, velocity, settings.period_s);
  }
  return out;
}

TEST(VelocityFilter, NothingThatStandsStillIsTouchedWhateverIsWanted) {
  const int steps = cases(50'000);
  EXPECT_EQ(walk({.period_s = 0.01, .latency_s = 0}, steps, false).least_m, 0);
  const Walk quick =
      walk({.least_distance_m = 0.03, .period_s = 0.004, .latency_s = 0}, steps, true);
  EXPECT_GE(quick.least_m, 0.03);
  EXPECT_GT(quick.moved, steps / 2);
  // Long steps, and late: what is solved for would lead too near.
  const Walk slow =
      walk({.least_distance_m = 0.03, .period_s = 0.1, .latency_s = 0.05}, steps, true);
  EXPECT_GE(slow.least_m, 0.03);
  EXPECT_GT(slow.shortened, steps / 200);
  EXPECT_GT(slow.moved, steps / 2);
}

TEST_F(Filtered, WhatIsTooNearMayBeLeftAndNotApproached) {
  VelocityFilter filter(arm.robot, {});
  put_in_front(0.02F);
  const double sign = sign_towards(filter);
  EXPECT_LE(approach_m_s(filter, update(filter, {sign, 0, 0, 0, 0, 0.5, 0}).velocity), 1e-9);
  const FilteredVelocity& out = update(filter, {-0.2 * sign, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(out.status, FilterStatus::ok);
  EXPECT_LT(approach_m_s(filter, out.velocity), -0.03);
}

TEST_F(Filtered, WhatTheJointsStillMoveUntilTheyObeyCounts) {
  VelocityFilter filter(arm.robot, {.latency_s = 0.03});
  put_in_front(0.08F);
  const Numbers wanted{0, 0, 0, 0, 0, 0, 0.1};
  EXPECT_EQ(update(filter, wanted).scale, 1);
  const FilteredVelocity& out = update(filter, wanted, Numbers(7, 1));
  EXPECT_EQ(out.status, FilterStatus::ok);
  EXPECT_EQ(out.velocity, Numbers(7, 0));
  EXPECT_FALSE(out.held_by.empty());
}

TEST_F(Filtered, InContactItStands) {
  VelocityFilter filter(arm.robot, {});
  put_in_front(0);
  const FilteredVelocity& out = update(filter, Numbers(7, 0.1));
  EXPECT_EQ(out.status, FilterStatus::contact);
  EXPECT_EQ(out.velocity, Numbers(7, 0));
  ASSERT_EQ(out.held_by.size(), 1U);
  EXPECT_EQ(out.held_by[0], (LinkRow{8, RowKind::nearest}));
}

TEST_F(Filtered, WithoutAnAnswerOrANumberItStands) {
  VelocityFilter filter(arm.robot, {});
  arm.ask(position);
  EXPECT_EQ(update(filter, Numbers(6, 0.1)).status, FilterStatus::bad_joints);
  const Numbers no_number(7, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(update(filter, no_number).status, FilterStatus::bad_joints);
  EXPECT_EQ(update(filter, Numbers(7, 0.1), no_number).status, FilterStatus::bad_joints);
  EXPECT_EQ(update(filter, Numbers(7, 0.1)).status, FilterStatus::ok);
  withhold(arm.result);
  const FilteredVelocity& out = update(filter, Numbers(7, 0.1));
  EXPECT_EQ(out.status, FilterStatus::stale);
  EXPECT_EQ(out.velocity, Numbers(7, 0));
}

TEST_F(Filtered, WhereTooLittleIsSeenItStandsUnlessToldNotTo) {
  VelocityFilter filter(arm.robot, {}), other(arm.robot, {.stop_unseen = false});
  arm.ask(position);
  const Numbers wanted(7, 0.1);
  for (const LinkStatus status : {LinkStatus::not_seen, LinkStatus::not_observed}) {
    arm.result.links[5].status = status;
    const FilteredVelocity& out = update(filter, wanted);
    EXPECT_EQ(out.status, FilterStatus::unseen);
    EXPECT_EQ(out.velocity, Numbers(7, 0));
    EXPECT_EQ(out.held_by, std::vector{(LinkRow{6, RowKind::nearest})});
    EXPECT_EQ(update(other, wanted).velocity, wanted);
  }
  // It stands where it stands.
  arm.result.links[5].is_moved = false;
  EXPECT_EQ(update(filter, wanted).status, FilterStatus::ok);
  arm.result.status = ResultStatus::degraded;
  EXPECT_EQ(update(filter, wanted).status, FilterStatus::unseen);
  EXPECT_TRUE(filter.update(arm.result, {position, wanted, wanted}).held_by.empty());
  EXPECT_EQ(update(other, wanted).status, FilterStatus::ok);
}

TEST_F(Filtered, WhereItCannotBrakeSoFastItStandsAndNamesTheRow) {
  VelocityFilter filter(arm.robot, {.latency_s = 0, .max_acceleration = 1});
  put_in_front(0.08F);
  update(filter, Numbers(7, 0));
  Numbers fast{1, 0, 0, 0, 0, 0, 0};
  if (approach_m_s(filter, fast) < 0) fast[0] = -1;
  const FilteredVelocity& out = update(filter, fast, fast);
  EXPECT_EQ(out.status, FilterStatus::no_solution);
  EXPECT_EQ(out.velocity, Numbers(7, 0));
  ASSERT_FALSE(out.held_by.empty());
  EXPECT_EQ(out.held_by[0], (LinkRow{8, RowKind::nearest}));
}

TEST_F(Filtered, AJointOfAnotherControllerTakesNoPartInIt) {
  VelocityFilter filter(arm.robot, {}), without(arm.robot, {}, {1, 3});
  put_in_front(0.2F);
  const double sign = sign_towards(filter);
  const Numbers wanted{sign, 0, 0, 0, 0, 0.5, 0};
  EXPECT_NE(update(filter, wanted).velocity[1], 0) << "it helps";
  const Numbers velocity = update(without, wanted).velocity;
  EXPECT_NEAR(velocity[1], 0, 1e-12);
  EXPECT_NEAR(velocity[3], 0, 1e-12);
  EXPECT_LE(approach_m_s(without, velocity), 2 * (0.2 - 0.001 - 0.05) + 1e-6);
  EXPECT_GT(std::abs(velocity[0]), 0.05) << "the others go on";
  EXPECT_THROW(VelocityFilter(arm.robot, {}, {7}), std::out_of_range);
}

TEST_F(Filtered, KeepsTheJointsLimits) {
  constexpr double kAcceleration = 3, kPeriod_s = 0.01;
  VelocityFilter filter(arm.robot,
                        {.period_s = kPeriod_s, .latency_s = 0, .max_acceleration = kAcceleration});
  sim::Random random(5);
  Numbers velocity(7, 0), wanted(7, 0);
  int at_limit = 0;
  for (int k = 0; k < cases(200'000); ++k) {
    if (k % 100 == 0) wanted = draw(random, 7, 9);
    // Nothing is near: the limits alone count.
    forward_kinematics(arm.model(), position, arm.result.pose);
    for (LinkResult& link : arm.result.links) {
      link.lower_bound_m = 1;
      link.status = LinkStatus::none_in_range;
    }
    arm.result.status = ResultStatus::ok;
    const FilteredVelocity& out = update(filter, wanted, velocity);
    ASSERT_EQ(out.status, FilterStatus::ok);
    for (std::size_t j = 0; j < position.size(); ++j) {
      const MovableJoint& joint = arm.model().joints[j];
      EXPECT_LE(std::abs(out.velocity[j]), joint.max_speed + 1e-6);
      const double at = position[j] + kPeriod_s * out.velocity[j];
      EXPECT_GE(at, joint.lower - 1e-6);
      EXPECT_LE(at, joint.upper + 1e-6);
      const bool is_braking = std::abs(out.velocity[j]) < std::abs(velocity[j]);
      const double change = std::abs(out.velocity[j] - velocity[j]);
      // The last step to a limit of the position may brake somewhat faster.
      if (out.scale == 1) {
        EXPECT_LE(change, (is_braking ? 2 : 1) * kAcceleration * kPeriod_s + 1e-6);
      }
      at_limit += at > joint.upper - 0.01 || at < joint.lower + 0.01;
    }
    velocity = out.velocity;
    go(position, velocity, kPeriod_s);
  }
  EXPECT_GT(at_limit, 0);
}

/// From near the left one of two walls towards the right one: by how much joint 1's velocity jumps
/// at most from one period to the next.
double greatest_jump_rad_s(int candidates) {
  RowsRobot arm(bundled_arm(), candidates);
  VelocityFilter filter(arm.robot, {.least_distance_m = 0.05, .latency_s = 0});
  Numbers position = kFree, velocity(7, 0);
  arm.ask(position);
  const Pose& X_BL = arm.result.pose.X_BL[arm.model().evaluated_links[7]];
  const Eigen::Vector3d left_B_m = X_BL * Eigen::Vector3d(0, 0.11, 0.1);
  const Eigen::Vector3d right_B_m = X_BL * Eigen::Vector3d(0, -0.16, 0.1);
  const Numbers wanted{-0.5, 0, 0, 0, 0, 0, 0};
  double most_rad_s = 0;
  for (int k = 0; k < 100; ++k) {
    arm.ask(position);
    LinkResult& link = arm.result.links[7];
    SpacePair other;
    put(arm, 7, {0, 0.05, 0.1}, left_B_m, link);
    put(arm, 7, {0, -0.05, 0.1}, right_B_m, other);
    if (other.distance_m < link.distance_m) std::swap<SpacePair>(link, other);
    link.candidates.clear();
    if (candidates > 1) link.candidates.emplace_back() = other;
    const Numbers before = velocity;
    velocity = filter.update(arm.result, {position, velocity, wanted}).velocity;
    if (k > 0) most_rad_s = std::max(most_rad_s, std::abs(velocity[0] - before[0]));
    go(position, velocity, 0.01);
  }
  return most_rad_s;
}

TEST(VelocityFilter, BetweenTwoWallsACandidateEndsTheJump) {
  EXPECT_GT(greatest_jump_rad_s(1), 3 * greatest_jump_rad_s(2));
}

TEST(VelocityFilter, ACandidateHoldsItBackAsTheNearestPairDoes) {
  RowsRobot arm(bundled_arm(), 2);
  VelocityFilter filter(arm.robot, {});
  arm.ask(kFree);
  const Pose& X_BL = arm.result.pose.X_BL[arm.model().evaluated_links[7]];
  LinkResult& link = arm.result.links[7];
  put(arm, 7, {0, 0.05, 0.1}, X_BL * Eigen::Vector3d(0, 0.12, 0.1), link);
  put(arm, 7, {0, -0.05, 0.1}, X_BL * Eigen::Vector3d(0, -0.14, 0.1),
      link.candidates.emplace_back());
  for (const double sign : {1.0, -1.0}) {
    const Numbers wanted{sign, 0, 0, 0, 0, 0, 0};
    const FilteredVelocity& out = filter.update(arm.result, {kFree, Numbers(7, 0), wanted});
    ASSERT_EQ(out.status, FilterStatus::ok);
    const Eigen::Map<const Eigen::VectorXd> v(out.velocity.data(), 7);
    for (const int candidate : {0, 1}) {
      const SpacePair& pair = candidate == 0 ? link : link.candidates[0];
      const double falls_m_s = -filter.rows().gradient(RowKind::nearest, candidate).row(7).dot(v);
      EXPECT_LE(falls_m_s, 2 * (pair.lower_bound_m - 0.05) + 1e-6);
    }
    ASSERT_FALSE(out.held_by.empty());
  }
  const Numbers towards_other{1, 0, 0, 0, 0, 0, 0}, away{-1, 0, 0, 0, 0, 0, 0};
  std::vector<int> held;
  for (const Numbers& wanted : {towards_other, away}) {
    const FilteredVelocity& out = filter.update(arm.result, {kFree, Numbers(7, 0), wanted});
    held.push_back(out.held_by.front().candidate);
  }
  std::ranges::sort(held);
  EXPECT_EQ(held, (std::vector{0, 1})) << "each wall holds it on its own side";
}

TEST_F(Filtered, AJointWithMoreWeightLeavesWhatIsWantedLess) {
  VelocityFilter filter(arm.robot, {});
  put_in_front(0.1F);
  const Numbers wanted{sign_towards(filter), 0, 0, 0, 0, 0, 0}, velocity(7, 0);
  const auto left = [&](const Numbers& weight) {
    const FilteredVelocity& out = filter.update(arm.result, {position, velocity, wanted, weight});
    EXPECT_EQ(out.status, FilterStatus::ok);
    return std::abs(out.velocity[0] - wanted[0]);
  };
  const double alike = left({});
  EXPECT_NEAR(left(Numbers(7, 3)), alike, 1e-9);
  EXPECT_LT(left({10, 1, 1, 1, 1, 1, 1}), 0.9 * alike);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const Numbers weight{1, 1, 1, bad, 1, 1, 1};
    EXPECT_EQ(filter.update(arm.result, {position, velocity, wanted, weight}).status,
              FilterStatus::bad_joints);
  }
  const Numbers few(6, 1);
  EXPECT_EQ(filter.update(arm.result, {position, velocity, wanted, few}).status,
            FilterStatus::bad_joints);
}

TEST_F(Filtered, AllocatesNothing) {
  VelocityFilter filter(arm.robot, {});
  put_in_front(0.1F);
  const Numbers wanted{1, -1, 0.5, 0, 0.2, 0.5, 0}, velocity(7, 0);
  const std::size_t before = allocation_count();
  filter.update(arm.result, {position, velocity, wanted});
  EXPECT_EQ(allocation_count(), before);
}

TEST_F(Filtered, RefusesWhatIsWrong) {
  EXPECT_EQ(
      error_message<std::invalid_argument>([&] { VelocityFilter(arm.robot, {.period_s = 0}); }),
      "velocity_filter.period_s: 0; expected a finite number above 0");
  EXPECT_EQ(error_message<std::invalid_argument>(
                [&] { VelocityFilter(arm.robot, {.max_acceleration = -1}); }),
            "velocity_filter.max_acceleration: -1; expected a number above 0");
}

}  // namespace
}  // namespace berth
