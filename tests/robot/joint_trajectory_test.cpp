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

TEST(JointTrajectory, AMissingSampleIsNamed) {
  const std::string message = error_message([] { trajectory({{1, {0, 0, 0, 0}}}).sample(1); });
  EXPECT_NE(message.find("joints.csv: 1 rows"), std::string::npos) << message;
  EXPECT_NE(message.find("frame 1"), std::string::npos) << message;
}

TEST(JointTrajectory, UnknownAndMissingJointsAreNamed) {
  const auto open = [](const std::vector<std::string>& names) {
    return error_message([&] {
      JointTrajectory(three_joints(), "joints.csv", names, {{0, {0, 0, 0, 0}}});
    });
  };
  EXPECT_NE(open({"turn", "wheel", "lift", "elbow"}).find("\"elbow\""), std::string::npos);
  EXPECT_NE(open({"turn", "wheel", "finger"}).find("\"lift\""), std::string::npos);
}

}  // namespace
}  // namespace berth
