#include "berth/robot/joint_trajectory.hpp"

#include <gtest/gtest.h>

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

const std::vector<std::string> kNames{"wheel", "turn", "finger", "lift"};

JointTrajectory trajectory(const std::vector<JointTrajectory::Sample>& samples) {
  return JointTrajectory(three_joints(), "joints.csv", kNames, samples);
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(JointTrajectory, TakesTheRobotsOrderAndLeavesMimicJointsOut) {
  EXPECT_EQ(trajectory({{0, {1, 2, 3, 4}}}).at(0).position, (std::vector<double>{2, 1, 4}));
  EXPECT_EQ(trajectory({{0, {1, 2, 3, 4}}}).sample(0).position, (std::vector<double>{2, 1, 4}));
}

TEST(JointTrajectory, IsLinearBetweenSamples) {
  const JointTrajectory joints =
      trajectory({{1, {0, 0, 0, 0}}, {3, {0.4, 1, 0, 2}}, {4, {0.4, 3, 0, 2}}});
  const JointState state = joints.at(1.5);
  EXPECT_EQ(state.stamp_s, 1.5);
  EXPECT_NEAR(state.position[0], 0.25, 1e-12);
  EXPECT_NEAR(state.position[1], 0.1, 1e-12);
  EXPECT_NEAR(state.position[2], 0.5, 1e-12);
  EXPECT_NEAR(joints.at(3.5).position[0], 2, 1e-12);
  EXPECT_EQ(joints.at(1).position[0], 0);
  EXPECT_EQ(joints.at(4).position[0], 3);
}

TEST(JointTrajectory, AContinuousJointTakesTheShorterWayRoundAndARevoluteOneDoesNot) {
  const JointState state = trajectory({{0, {3.1, 3.1, 0, 0}}, {1, {-3.1, -3.1, 0, 0}}}).at(0.5);
  EXPECT_NEAR(state.position[0], 0, 1e-12);
  EXPECT_NEAR(state.position[1], std::numbers::pi, 1e-12);
}

TEST(JointTrajectory, NothingIsExtrapolated) {
  const JointTrajectory joints = trajectory({{1, {0, 0, 0, 0}}, {2, {0, 0, 0, 0}}});
  for (const double time_s : {0.99, 2.01, std::numeric_limits<double>::quiet_NaN()}) {
    const std::string message = message_of([&] { joints.at(time_s); });
    EXPECT_NE(message.find("joints.csv"), std::string::npos);
    EXPECT_NE(message.find("from 1 to 2 s"), std::string::npos);
  }
}

TEST(JointTrajectory, AMissingSampleIsNamed) {
  const std::string message = message_of([] { trajectory({{1, {0, 0, 0, 0}}}).sample(1); });
  EXPECT_NE(message.find("joints.csv: 1 rows"), std::string::npos) << message;
  EXPECT_NE(message.find("frame 1"), std::string::npos) << message;
}

TEST(JointTrajectory, UnknownAndMissingJointsAreNamed) {
  const auto open = [](const std::vector<std::string>& names) {
    return message_of([&] {
      JointTrajectory(three_joints(), "joints.csv", names, {{0, {0, 0, 0, 0}}});
    });
  };
  EXPECT_NE(open({"turn", "wheel", "lift", "elbow"}).find("\"elbow\""), std::string::npos);
  EXPECT_NE(open({"turn", "wheel", "finger"}).find("\"lift\""), std::string::npos);
}

}  // namespace
}  // namespace berth
