#include "berth/robot/joint_buffer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <thread>

namespace berth {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr JointTimeLimits kLimits{.max_skew_s = 0.2, .max_extrapolation_s = 0.05};

RobotModel two_joints() {
  RobotModel model;
  model.joints = {{"turn", JointType::revolute}, {"wheel", JointType::continuous}};
  return model;
}

const std::vector<std::string> kNames{"wheel", "gripper", "turn"};

TimeStatus push(JointBuffer& buffer, double stamp_s, double turn, double wheel) {
  return buffer.push(stamp_s, kNames, std::array{wheel, 9.0, turn});
}

class Buffer : public testing::Test {
 protected:
  FrameTime at(double time_s) { return buffer_.at(time_s, kLimits, joints_); }

  JointBuffer buffer_{two_joints(), 4};
  JointState joints_;
};

TEST_F(Buffer, InterpolatesInTheRobotsOrderTheShorterWayRound) {
  push(buffer_, 1.0, 0.0, 3.1);
  push(buffer_, 1.2, 0.4, -3.1);
  const FrameTime time = at(1.15);
  EXPECT_EQ(time.status, TimeStatus::ok);
  EXPECT_NEAR(time.skew_s, 0.05, 1e-12);
  EXPECT_EQ(joints_.stamp_s, 1.15);
  EXPECT_NEAR(joints_.position[0], 0.3, 1e-12);
  EXPECT_NEAR(std::remainder(joints_.position[1], 2 * std::numbers::pi),
              3.1 + 0.75 * (2 * std::numbers::pi - 6.2) - 2 * std::numbers::pi, 1e-12);
  EXPECT_EQ(at(1.2).skew_s, 0);
  EXPECT_EQ(joints_.position[0], 0.4);
}

TEST_F(Buffer, ExtrapolatesUpToTheLimitAndNoFurther) {
  push(buffer_, 1.0, 0.0, 0.0);
  push(buffer_, 1.1, 0.1, 0.0);
  EXPECT_EQ(at(1.14).status, TimeStatus::ok);
  EXPECT_NEAR(joints_.position[0], 0.14, 1e-12);
  EXPECT_EQ(at(0.96).status, TimeStatus::ok);
  EXPECT_NEAR(joints_.position[0], -0.04, 1e-12);
  for (const double time_s : {1.16, 0.94, 100.0, kNaN}) {
    EXPECT_EQ(at(time_s).status, TimeStatus::extrapolated_too_far) << time_s;
    EXPECT_EQ(joints_.position.size(), 2U);
    EXPECT_TRUE(std::isnan(joints_.position[0]) && std::isnan(joints_.position[1])) << time_s;
  }
}

TEST_F(Buffer, OneSampleIsHeldWithinTheLimit) {
  EXPECT_EQ(at(1).status, TimeStatus::no_joints);
  push(buffer_, 1.0, 0.7, 0.0);
  EXPECT_EQ(at(1.04).status, TimeStatus::ok);
  EXPECT_EQ(joints_.position[0], 0.7);
  EXPECT_EQ(at(1.06).status, TimeStatus::extrapolated_too_far);
}

TEST_F(Buffer, AGapBetweenSamplesIsSkew) {
  push(buffer_, 1, 0, 0);
  push(buffer_, 2, 1, 0);
  EXPECT_EQ(at(1.19).status, TimeStatus::ok);
  const FrameTime middle = at(1.4);
  EXPECT_EQ(middle.status, TimeStatus::skewed);
  EXPECT_NEAR(middle.skew_s, 0.4, 1e-12);
  EXPECT_TRUE(std::isnan(joints_.position[0]));
}

TEST_F(Buffer, KeepsTheNewestSamples) {
  for (int i = 0; i < 10; ++i) EXPECT_EQ(push(buffer_, 0.125 * i, i, 0), TimeStatus::ok);
  EXPECT_EQ(at(0.75).status, TimeStatus::ok);
  EXPECT_EQ(joints_.position[0], 6);
  EXPECT_EQ(at(0.625).status, TimeStatus::extrapolated_too_far);
}

TEST_F(Buffer, ALateSampleIsPassedOverUntilTheBufferIsCleared) {
  push(buffer_, 5.0, 1, 0);
  for (const double stamp_s : {5.0, 4.9}) {
    EXPECT_EQ(push(buffer_, stamp_s, 2, 0), TimeStatus::stamp_went_back);
  }
  EXPECT_EQ(push(buffer_, kNaN, 2, 0), TimeStatus::stamp_jumped);
  EXPECT_EQ(buffer_.newest(joints_), TimeStatus::ok);
  EXPECT_EQ(joints_.position[0], 1);
  buffer_.clear();
  EXPECT_EQ(buffer_.newest(joints_), TimeStatus::no_joints);
  EXPECT_EQ(push(buffer_, 0.1, 3, 0), TimeStatus::ok);
}

TEST_F(Buffer, AMissingJointIsNamedAndNothingOlderIsTakenForIt) {
  push(buffer_, 1.0, 0.5, 0);
  push(buffer_, 1.1, 0.6, 0);
  EXPECT_EQ(buffer_.push(1.2, std::vector<std::string>{"wheel"}, std::array{0.0}),
            TimeStatus::missing_joint);
  EXPECT_EQ(buffer_.missing_joint(), "turn");
  EXPECT_EQ(buffer_.newest(joints_), TimeStatus::missing_joint);
  EXPECT_TRUE(std::isnan(joints_.position[0]));
  EXPECT_EQ(at(1.2).status, TimeStatus::missing_joint);
  EXPECT_EQ(at(1.05).status, TimeStatus::ok) << "between whole samples nothing is missing";
  EXPECT_EQ(push(buffer_, 1.2, 0.7, kNaN), TimeStatus::missing_joint);
  EXPECT_EQ(buffer_.missing_joint(), "wheel");
  EXPECT_EQ(push(buffer_, 1.2, 0.7, 0), TimeStatus::ok);
  EXPECT_EQ(buffer_.missing_joint(), "");
  EXPECT_EQ(buffer_.newest(joints_), TimeStatus::ok);
}

TEST_F(Buffer, VelocityIsTheWayOfAWindowOverItsTime) {
  std::vector<double> velocity;
  EXPECT_EQ(buffer_.velocity(0.02, velocity), TimeStatus::no_joints);
  push(buffer_, 1.00, 0.0, 3.1);
  EXPECT_EQ(buffer_.velocity(0.02, velocity), TimeStatus::no_joints);
  EXPECT_TRUE(std::isnan(velocity.at(0)));
  push(buffer_, 1.01, 0.1, -3.1);
  EXPECT_EQ(buffer_.velocity(0.02, velocity), TimeStatus::ok) << "the oldest, where none is older";
  EXPECT_NEAR(velocity.at(0), 10, 1e-9);
  EXPECT_NEAR(velocity.at(1), (2 * std::numbers::pi - 6.2) / 0.01, 1e-9);
  push(buffer_, 1.02, 0.4, -3.1);
  push(buffer_, 1.03, 0.7, -3.1);
  EXPECT_EQ(buffer_.velocity(0.015, velocity), TimeStatus::ok);
  EXPECT_NEAR(velocity.at(0), 30, 1e-9);
  EXPECT_NEAR(velocity.at(1), 0, 1e-9);
  buffer_.push(1.04, std::vector<std::string>{"wheel"}, std::array{0.0});
  EXPECT_EQ(buffer_.velocity(0.015, velocity), TimeStatus::missing_joint);
  EXPECT_TRUE(std::isnan(velocity.at(1)));
}

TEST_F(Buffer, WrongUseIsRefused) {
  EXPECT_THROW(JointBuffer(two_joints(), 1), std::invalid_argument);
  EXPECT_THROW(buffer_.push(0, kNames, std::array{1.0}), std::invalid_argument);
}

TEST(JointBuffer, OneThreadPushesWhileAnotherLooksUp) {
  JointBuffer buffer(two_joints(), 8);
  push(buffer, 0, 0, 0);
  std::thread pusher([&] {
    for (int i = 1; i <= 2000; ++i) push(buffer, i, i, 0);
  });
  JointState joints;
  double last_s = 0;
  while (last_s < 2000) {
    ASSERT_EQ(buffer.newest(joints), TimeStatus::ok);
    ASSERT_EQ(joints.position[0], joints.stamp_s);
    ASSERT_GE(joints.stamp_s, last_s);
    last_s = joints.stamp_s;
  }
  pusher.join();
}

}  // namespace
}  // namespace berth
