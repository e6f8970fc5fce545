#include "berth/robot/joint_trajectory.hpp"
#include "tests/support/error_message.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

namespace berth {
namespace {

RobotModel three_joints() {
  RobotModel model;
  model.name = "three";
  model.joints = {{"turn", JointType::revolute},
                  {"wheel", JointType::continuous},
                  {"lift", JointType::prismatic}};
  model.mimic_joints = {"finger"};
  return model;
}

const std::vector<std::string> kColumnNames{"wheel", "turn", "finger", "lift"};

JointTrajectory trajectory(const std::vector<JointTrajectory::Sample>& samples) {
  return JointTrajectory(three_joints(), "joints.csv", kColumnNames, samples);
}

/// Where no limit forbids it.
JointState at(const JointTrajectory& joints, double time_s) {
  JointState state;
  EXPECT_EQ(joints.at(time_s, kOnlyBetweenSamples, state).status, TimeStatus::ok);
  return state;
}

TEST(JointTrajectory, TakesTheRobotsOrderAndLeavesMimicJointsOut) {
  EXPECT_EQ(at(trajectory({{0, {1, 2, 3, 4}}}), 0).position, (std::vector<double>{2, 1, 4}));
  EXPECT_EQ(trajectory({{0, {1, 2, 3, 4}}}).sample(0).position, (std::vector<double>{2, 1, 4}));
}

TEST(JointTrajectory, IsLinearBetweenSamples) {
  const JointTrajectory joints =
      trajectory({{1, {0, 0, 0, 0}}, {3, {0.4, 1, 0, 2}}, {4, {0.4, 3, 0, 2}}});
  const JointState state = at(joints, 1.5);
  EXPECT_EQ(state.stamp_s, 1.5);
  EXPECT_NEAR(state.position[0], 0.25, 1e-12);
  EXPECT_NEAR(state.position[1], 0.1, 1e-12);
  EXPECT_NEAR(state.position[2], 0.5, 1e-12);
  EXPECT_NEAR(at(joints, 3.5).position[0], 2, 1e-12);
  EXPECT_EQ(at(joints, 1).position[0], 0);
  EXPECT_EQ(at(joints, 4).position[0], 3);
}

TEST(JointTrajectory, AContinuousJointTakesTheShorterWayRoundAndARevoluteOneDoesNot) {
  const JointState state = at(trajectory({{0, {3.1, 3.1, 0, 0}}, {1, {-3.1, -3.1, 0, 0}}}), 0.5);
  EXPECT_NEAR(state.position[0], 0, 1e-12);
  EXPECT_NEAR(state.position[1], std::numbers::pi, 1e-12);
}

TEST(JointTrajectory, NothingIsExtrapolatedUnlessTheLimitAllowsIt) {
  const JointTrajectory joints = trajectory({{1, {0, 0, 0, 0}}, {2, {0, 1, 0, 0}}});
  EXPECT_EQ(joints.first_s(), 1);
  EXPECT_EQ(joints.last_s(), 2);
  EXPECT_EQ(joints.source(), "joints.csv");
  JointState state;
  for (const double time_s : {0.99, 2.01, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(joints.at(time_s, kOnlyBetweenSamples, state).status,
              TimeStatus::extrapolated_too_far);
    EXPECT_TRUE(std::isnan(state.position[0]));
  }
  EXPECT_EQ(joints.at(2.1, {.max_skew_s = 1, .max_extrapolation_s = 0.2}, state).status,
            TimeStatus::ok);
  EXPECT_NEAR(state.position[0], 1.1, 1e-12);
}

TEST(JointTrajectory, VelocityIsTheSlopeBetweenTheSamplesAround) {
  const JointTrajectory joints =
      trajectory({{1, {3.1, 0, 0, 0}}, {2, {-3.1, 1, 0, 2}}, {4, {-3.1, 2, 0, 2}}});
  std::vector<double> velocity;
  for (const double time_s : {1.0, 1.5, 2.0}) {
    joints.velocity(time_s, velocity);
    ASSERT_EQ(velocity.size(), 3U);
    EXPECT_NEAR(velocity[0], 1, 1e-12);
    EXPECT_NEAR(velocity[1], 2 * std::numbers::pi - 6.2, 1e-12);
    EXPECT_NEAR(velocity[2], 2, 1e-12);
  }
  joints.velocity(3, velocity);
  EXPECT_NEAR(velocity[0], 0.5, 1e-12);
  for (const double time_s : {0.99, 4.01, std::nan("")}) {
    joints.velocity(time_s, velocity);
    EXPECT_TRUE(std::isnan(velocity[0])) << time_s;
  }
  trajectory({{1, {0, 0, 0, 0}}}).velocity(1, velocity);
  EXPECT_TRUE(std::isnan(velocity[0])) << "one sample has no slope";
}

TEST(JointTrajectory, FarFromASampleARobotThatMovesMayBeAnywhere) {
  const JointTrajectory joints =
      trajectory({{0, {0, 0, 0, 0}}, {2, {0.5, 0, 0, 0}}, {4, {0.51, 0, 0, 0}}});
  JointState state;
  EXPECT_EQ(joints.at(0.09, kInRecordings, state).status, TimeStatus::ok);
  EXPECT_EQ(joints.at(1, kInRecordings, state).status, TimeStatus::skewed);
  EXPECT_TRUE(std::isnan(state.position[0]));
  // It stood still.
  EXPECT_EQ(joints.at(3, kInRecordings, state).status, TimeStatus::ok);
  EXPECT_NEAR(state.position[1], 0.505, 1e-12);
  EXPECT_EQ(joints.at(4.2, kInRecordings, state).status, TimeStatus::extrapolated_too_far);
}

TEST(JointTrajectory, AMissingJointIsNamed) {
  expect_parts(error_message([] {
                 JointTrajectory(three_joints(), "joints.csv", {"turn", "wheel", "finger"},
                                 {{0, {0, 0, 0}}});
               }),
               {"joints.csv: joint \"lift\"", "the columns are turn, wheel, finger"});
}

/// Of three_joints() with these limits of "turn" and "lift".
std::vector<std::string> doubts_of(const std::vector<JointTrajectory::Sample>& samples,
                                   const std::vector<std::string>& names = kColumnNames) {
  RobotModel model = three_joints();
  model.joints[0].lower = -2;
  model.joints[0].upper = 2;
  model.joints[0].max_speed = 1;
  model.joints[2].lower = 0;
  model.joints[2].upper = 0.04;
  return JointTrajectory(model, "joints.csv", names, samples).doubts(model);
}

TEST(JointTrajectory, NothingIsDoubtedOfARobotThatMovesAsItCan) {
  EXPECT_TRUE(
      doubts_of({{0, {0, 0, 0, 0}}, {1, {3, 1, 0, 0.04}}, {1.01, {3.05, 1.02, 0, 0}}}).empty());
  // Stamps that jitter, and a continuous joint that goes on over half a turn.
  EXPECT_TRUE(doubts_of({{0, {3.1, 0, 0, 0}}, {0.001, {-3.1, 0.05, 0, 0}}}).empty());
}

TEST(JointTrajectory, ColumnsThatAreNotUsedAreTold) {
  const std::vector<std::string> doubts =
      doubts_of({{0, {0, 0, 0, 0, 7}}}, {"wheel", "turn", "finger", "lift", "elbow"});
  ASSERT_EQ(doubts.size(), 1U);
  expect_parts(doubts[0], {"joints.csv: not used: elbow; robot three"});
}

TEST(JointTrajectory, AJointThatJumpsIsTold) {
  const std::vector<std::string> doubts = doubts_of(
      {{0, {0, 1.2, 0, 0}}, {0.01, {0, 0, 0, 0}}, {0.02, {0, 1.2, 0, 0}}, {0.03, {0, 0, 0, 0}}});
  ASSERT_EQ(doubts.size(), 1U);
  expect_parts(doubts[0], {"joint turn jumps from 1.2 to 0 rad within 0.01 s, at 0.01 s",
                           "expected 3 rad/s", "two nodes publish"});
  // Where the URDF has no limit.
  EXPECT_EQ(doubts_of({{0, {0, 0, 0, 0}}, {0.01, {1.2, 0, 0, 0}}}).size(), 1U);
}

TEST(JointTrajectory, APositionBeyondTheLimitsIsTold) {
  const std::vector<std::string> doubts = doubts_of({{0, {0, 0, 0, 35}}, {9, {0, -2.2, 0, 35}}});
  ASSERT_EQ(doubts.size(), 2U);
  expect_parts(doubts[0], {"joint turn is at -2.2 rad, at 9 s; its limits are -2 to 2"});
  expect_parts(doubts[1], {"joint lift is at 35 m, at 0 s; its limits are 0 to 0.04"});
}

}  // namespace
}  // namespace berth
