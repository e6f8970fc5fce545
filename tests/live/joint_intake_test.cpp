#include "berth/live/joint_intake.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/error_message.hpp"

namespace berth {
namespace {

using ::testing::Test;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr JointTimeLimits kLimits{.max_skew_s = 1};

RobotModel arm_and_gripper() {
  RobotModel model;
  model.joints = {{"shoulder", JointType::revolute},
                  {"wrist", JointType::continuous},
                  {"finger", JointType::prismatic}};
  return model;
}

using Names = std::vector<std::string>;
using Positions = std::vector<double>;

class Intake : public Test {
 protected:
  TimeStatus arm(double stamp_s, double shoulder, double wrist = 0) {
    return intake_->push(stamp_s, Names{"wrist", "shoulder"}, Positions{wrist, shoulder});
  }
  TimeStatus gripper(double stamp_s, double finger) {
    return intake_->push(stamp_s, Names{"finger", "a joint of somebody else"},
                         Positions{finger, 9});
  }
  TimeStatus at(double time_s) { return intake_->buffer().at(time_s, kLimits, joints_).status; }
  double newest_s() const { return intake_->buffer().newest_stamp_s(); }
  void with(const JointIntakeSettings& settings) { intake_.emplace(arm_and_gripper(), settings); }

  std::optional<JointIntake> intake_{std::in_place, arm_and_gripper(), JointIntakeSettings{}};
  JointState joints_;
};

TEST_F(Intake, AWholeMessageIsAWholeSampleAtOnce) {
  const Names names{"finger", "wrist", "shoulder"};
  EXPECT_EQ(intake_->push(1, names, Positions{3, 2, 1}), TimeStatus::ok);
  EXPECT_EQ(newest_s(), 1);
  EXPECT_EQ(intake_->push(2, names, Positions{30, 20, 10}), TimeStatus::ok);
  ASSERT_EQ(at(2), TimeStatus::ok);
  EXPECT_EQ(joints_.position, (Positions{10, 20, 30}));
  EXPECT_EQ(intake_->waiting_for(), "");
}

TEST_F(Intake, EachJointIsInterpolatedBetweenItsOwnMessages) {
  gripper(0.0, 0);
  arm(0.1, 1);
  arm(0.2, 2);
  EXPECT_TRUE(std::isnan(newest_s())) << "where the finger is at 0.1 s nobody knows yet";
  EXPECT_EQ(intake_->waiting_for(), "finger");
  gripper(0.4, 8);
  EXPECT_EQ(newest_s(), 0.2);
  ASSERT_EQ(at(0.15), TimeStatus::ok);
  EXPECT_NEAR(joints_.position[0], 1.5, 1e-12);
  EXPECT_NEAR(joints_.position[2], 3, 1e-12);
  arm(0.5, 5);
  EXPECT_EQ(newest_s(), 0.4) << "the gripper's own stamp makes a sample";
  ASSERT_EQ(at(0.4), TimeStatus::ok);
  EXPECT_NEAR(joints_.position[0], 4, 1e-12);
}

TEST_F(Intake, MessagesOfSeveralPublishersMayComeInAnyOrder) {
  arm(0.3, 3);
  gripper(0.1, 1);
  gripper(0.3, 3);
  gripper(0.5, 5);
  arm(0.5, 5);
  ASSERT_EQ(at(0.4), TimeStatus::ok);
  EXPECT_NEAR(joints_.position[0], 4, 1e-12);
  EXPECT_NEAR(joints_.position[2], 4, 1e-12);
}

TEST_F(Intake, ContinuousJointsGoTheShorterWayRound) {
  gripper(0, 0);
  gripper(1, 0);
  intake_->push(0, Names{"wrist"}, Positions{3.1});
  intake_->push(1, Names{"wrist"}, Positions{-3.1});
  intake_->push(0, Names{"shoulder"}, Positions{0});
  intake_->push(0.5, Names{"shoulder"}, Positions{0});
  ASSERT_EQ(newest_s(), 0.5);
  ASSERT_EQ(at(0.5), TimeStatus::ok);
  EXPECT_NEAR(std::cos(joints_.position[1]), -1, 1e-3);
}

TEST_F(Intake, AJointIsHeldAsLongAsItIsAllowed) {
  with({.max_hold_s = 0.2});
  gripper(0, 7);
  arm(0.0, 0);
  arm(0.1, 1);
  EXPECT_EQ(newest_s(), 0.1);
  ASSERT_EQ(at(0.1), TimeStatus::ok);
  EXPECT_EQ(joints_.position[2], 7);
  arm(0.3, 3);
  EXPECT_EQ(newest_s(), 0.1) << "0.3 s is too long";
  gripper(0.25, 8);
  EXPECT_EQ(newest_s(), 0.3);
}

TEST_F(Intake, AJointThatNobodyTellsIsNamedUntilItIsFixed) {
  for (const double stamp_s : {0.0, 1.0}) arm(stamp_s, 1);
  EXPECT_EQ(at(0.5), TimeStatus::no_joints);
  EXPECT_EQ(intake_->waiting_for(), "finger");
  with({.offsets = {{"shoulder", 0.25}}, .fixed = {{"finger", 0.03}}});
  for (const double stamp_s : {0.0, 1.0}) arm(stamp_s, 1);
  ASSERT_EQ(at(0.5), TimeStatus::ok);
  EXPECT_EQ(joints_.position, (Positions{1.25, 0, 0.03}));
}

TEST_F(Intake, ARobotWhoseJointsAreAllFixedStandsStill) {
  with({.fixed = {{"finger", 1}, {"shoulder", 2}, {"wrist", 3}}});
  EXPECT_EQ(arm(5, 9), TimeStatus::ok);
  EXPECT_EQ(newest_s(), 5);
  ASSERT_EQ(at(5), TimeStatus::ok);
  EXPECT_EQ(joints_.position, (Positions{2, 3, 1}));
}

TEST_F(Intake, APositionThatNoRobotHasIsRefusedByName) {
  RobotModel model = arm_and_gripper();
  model.joints[0].lower = -3;
  model.joints[0].upper = 3;
  model.joints[2].lower = 0;
  model.joints[2].upper = 0.04;
  JointIntake intake(model, {});
  const auto why = [&](const std::string& joint, double position) {
    return error_message<std::invalid_argument>(
        [&] { intake.push(1, Names{joint}, Positions{position}); });
  };
  expect_parts(why("shoulder", kNaN), {"joint shoulder: nan", "-9.3 to 9.3"});
  expect_parts(why("shoulder", 1e9), {"joint shoulder: 1000000000", "-9.3 to 9.3"});
  expect_parts(why("shoulder", -57.3), {"joint shoulder: -57.3"});
  expect_parts(why("finger", 40), {"joint finger: 40", "-1 to 1.04"});
  expect_parts(why("wrist", 1e9), {"joint wrist", "-1000000 to 1000000"});
  EXPECT_EQ(intake.waiting_for(), "shoulder") << "nothing was taken";
  for (const double turned : {-9.2, 6.28, 9.2}) {
    EXPECT_EQ(intake.push(turned, Names{"shoulder"}, Positions{turned}), TimeStatus::ok)
        << "a robot may go beyond limits that its URDF has too narrow";
  }
  EXPECT_EQ(intake.push(1, Names{"wrist"}, Positions{5e5}), TimeStatus::ok);
}

TEST_F(Intake, WhatIsOfNoUseIsPassedOverAndSaid) {
  EXPECT_EQ(intake_->push(1, Names{"other"}, Positions{1}), TimeStatus::missing_joint);
  EXPECT_EQ(gripper(kNaN, 1), TimeStatus::stamp_jumped);
  EXPECT_EQ(gripper(1, 1), TimeStatus::ok);
  EXPECT_EQ(gripper(1, 2), TimeStatus::stamp_went_back);
  EXPECT_EQ(gripper(0.5, 2), TimeStatus::stamp_went_back) << "late";
  EXPECT_EQ(arm(1, 1), TimeStatus::ok);
  ASSERT_EQ(at(1), TimeStatus::ok);
  EXPECT_EQ(joints_.position[2], 1);
}

TEST_F(Intake, AClockThatIsSetBackByWhateverTimeBeginsAnew) {
  for (const double back_s : {0.3, 0.8, 97.0}) {
    with({});
    for (const double stamp_s : {99.0, 100.0}) {
      arm(stamp_s, 1);
      gripper(stamp_s, 0);
    }
    const double begin_s = 100 - back_s;
    EXPECT_EQ(arm(begin_s + 0.01, 0.3), TimeStatus::stamp_went_back);
    EXPECT_EQ(arm(begin_s + 0.12, 0.3), TimeStatus::stamp_went_back);
    EXPECT_EQ(arm(begin_s + 0.12, 0.3), TimeStatus::stamp_went_back)
        << "a message that comes twice";
    EXPECT_EQ(intake_->restarts(), 0);
    EXPECT_EQ(arm(begin_s + 0.13, 0.3), TimeStatus::ok) << back_s;
    EXPECT_EQ(intake_->restarts(), 1);
    EXPECT_EQ(at(99.5), TimeStatus::no_joints) << "nothing of the former time is left";
    gripper(begin_s + 0.13, 0);
    arm(begin_s + 0.14, 0.4);
    gripper(begin_s + 0.14, 0);
    ASSERT_EQ(at(begin_s + 0.135), TimeStatus::ok);
    EXPECT_NEAR(joints_.position[0], 0.35, 1e-9);
  }
}

TEST_F(Intake, LateMessagesAmongNewerOnesAreNoClockThatIsSetBack) {
  gripper(0, 0);
  for (int i = 1; i < 50; ++i) {
    EXPECT_EQ(arm(i, 1), TimeStatus::ok);
    for (int k = 0; k < 5; ++k) {
      EXPECT_EQ(arm(i - 0.5 + 0.01 * k, 2), TimeStatus::stamp_went_back) << "a second publisher's";
    }
  }
  // Each before the one before it: nobody's time goes on.
  for (const double stamp_s : {40, 30, 20, 10})
    EXPECT_EQ(arm(stamp_s, 2), TimeStatus::stamp_went_back);
  EXPECT_EQ(intake_->restarts(), 0);
}

TEST_F(Intake, OneStampOfAnotherTimeCostsThreeMessages) {
  gripper(0, 0);
  EXPECT_EQ(arm(1e9, 1), TimeStatus::ok);
  EXPECT_EQ(arm(1, 1), TimeStatus::stamp_went_back);
  EXPECT_EQ(arm(2, 1), TimeStatus::stamp_went_back);
  EXPECT_EQ(arm(3, 1), TimeStatus::ok);
}

TEST(JointIntake, WithoutAJointToTellTimeMayBeginAnewToo) {
  JointIntake intake(RobotModel(), {});
  const auto push = [&](double stamp_s) { return intake.push(stamp_s, Names{}, Positions{}); };
  for (const double stamp_s : {10, 11}) EXPECT_EQ(push(stamp_s), TimeStatus::ok);
  for (const double stamp_s : {1, 2}) EXPECT_EQ(push(stamp_s), TimeStatus::stamp_went_back);
  EXPECT_EQ(push(3), TimeStatus::ok);
  EXPECT_EQ(intake.buffer().newest_stamp_s(), 3);
}

TEST_F(Intake, ALongWaitTakesBoundedMemory) {
  for (int i = 0; i < 5000; ++i) arm(i * 0.001, i);
  EXPECT_TRUE(std::isnan(newest_s()));
  gripper(0, 0);
  gripper(5, 0);
  EXPECT_EQ(newest_s(), 4.999);
  EXPECT_EQ(at(4.5), TimeStatus::ok);
  EXPECT_NE(at(3.5), TimeStatus::ok) << "the oldest are gone";
}

TEST_F(Intake, WrongSettingsAndMessagesAreRefused) {
  const auto expect = [&](const JointIntakeSettings& settings,
                          const std::vector<std::string>& parts) {
    expect_parts(error_message<std::invalid_argument>([&] { with(settings); }), parts);
  };
  expect({.offsets = {{"elbow", 0}}}, {"joint_offsets.elbow", "no joint"});
  expect({.fixed = {{"elbow", 0}}}, {"fixed_joints.elbow", "no joint"});
  expect({.fixed = {{"finger", kNaN}}}, {"fixed_joints.finger", "nan", "finite"});
  expect({.max_hold_s = -1}, {"max_hold_s", "-1", "at least 0"});
  expect({.capacity = 1}, {"capacity"});
  with({});
  EXPECT_THROW(intake_->push(0, Names{"finger"}, Positions{}), std::invalid_argument);
}

}  // namespace
}  // namespace berth
