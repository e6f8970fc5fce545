// What a program wants, beside what its controller gets.
#include "velocity_commands.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

#include "sliding_robot.hpp"

namespace berth_ros {
namespace {

using Numbers = std::vector<double>;

class Commands : public testing::Test {
 protected:
  void use(const std::vector<std::string>& joints) {
    commands_ = std::make_unique<VelocityCommands>(joints);
    commands_->use(commands_->make(sliding_.robot, {}));
  }
  void want(const Numbers& velocities) {
    VelocityCommands::Message message;
    message.data = velocities;
    commands_->take(message);
  }
  Numbers allowed(const Numbers& position = {0, 0}) {
    VelocityCommands::Message out;
    commands_->allow(sliding_.result, position, Numbers{0, 0}, out);
    return out.data;
  }
  diagnostic_msgs::msg::DiagnosticStatus report() {
    diagnostic_updater::DiagnosticStatusWrapper status;
    commands_->report(status);
    return status;
  }
  std::string error_of(const std::vector<std::string>& joints) {
    try {
      use(joints);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }

  SlidingRobot sliding_;
  std::unique_ptr<VelocityCommands> commands_;
};

TEST_F(Commands, PassInTheOrderOfTheControllerWhereNothingIsNear) {
  use({});
  EXPECT_EQ(allowed(), (Numbers{0, 0})) << "nothing is wanted yet";
  want({0.1, 0.2});
  EXPECT_EQ(allowed(), (Numbers{0.1, 0.2}));
  EXPECT_EQ(commands_->trouble(), "");
  use({"turn", "slide"});
  want({0.1, 0.2});
  EXPECT_EQ(allowed(), (Numbers{0.1, 0.2}));
  use({"turn"});
  want({0.1});
  EXPECT_EQ(allowed(), Numbers{0.1});
}

TEST_F(Commands, AreShortenedByTheirOwnJoint) {
  sliding_.put_near_hand(0.1F);
  use({"turn", "slide"});
  want({0, 1});
  const Numbers velocity = allowed();
  EXPECT_NEAR(velocity[0], 0, 0.02);
  EXPECT_GT(velocity[1], 0.01);
  EXPECT_LE(velocity[1], 2 * (0.1 - 0.05));
  want({0, -1});
  EXPECT_EQ(allowed(), (Numbers{0, -1})) << "away from it";
  EXPECT_EQ(commands_->trouble(), "");
}

TEST_F(Commands, AreZeroOnceNobodyWantsAnyMore) {
  use({});
  want({0.1, 0.2});
  std::this_thread::sleep_for(VelocityCommands::kMostSilence + std::chrono::milliseconds(20));
  EXPECT_EQ(allowed(), (Numbers{0, 0}));
  EXPECT_EQ(commands_->trouble(), "") << "that is no fault";
  EXPECT_EQ(report().message, "nothing is wanted");
}

TEST_F(Commands, OfOtherJointsAreRefusedWithThoseThatWereExpected) {
  use({});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Numbers& wrong : {Numbers{0.1, 0.2, 0.3}, Numbers{}, Numbers{0.1, nan}}) {
    want({0.1, 0.2});
    want(wrong);
    EXPECT_EQ(allowed(), (Numbers{0, 0}));
    const std::string why = commands_->trouble();
    EXPECT_EQ(why.find("wanted_velocity: " + std::to_string(wrong.size()) + " numbers"), 0U) << why;
    EXPECT_NE(why.find("expected 2 finite ones, of slide, turn"), std::string::npos) << why;
  }
  want({0.1, 0.2});
  EXPECT_EQ(allowed(), (Numbers{0.1, 0.2}));
  EXPECT_EQ(commands_->trouble(), "");
  EXPECT_NE(error_of({"slide", "lift"})
                .find("\"lift\" is no joint of the robot; expected some of "
                      "slide, turn"),
            std::string::npos);
  EXPECT_NE(error_of({"turn", "turn"}).find("\"turn\" stands twice"), std::string::npos);
}

TEST_F(Commands, AreZeroWhereTheFilterSaysSoAndTellWhy) {
  use({});
  want({0.1, 0.2});
  EXPECT_EQ(allowed({0, std::numeric_limits<double>::quiet_NaN()}), (Numbers{0, 0}));
  EXPECT_EQ(commands_->trouble().find("bad_joints"), 0U) << commands_->trouble();
  sliding_.result.links[2].status = berth::LinkStatus::not_seen;
  EXPECT_EQ(allowed(), (Numbers{0, 0}));
  EXPECT_EQ(commands_->trouble(), "unseen: hand (nearest)");
  sliding_.result.status = berth::ResultStatus::stale;
  EXPECT_EQ(allowed(), (Numbers{0, 0}));
  EXPECT_EQ(commands_->trouble().find("stale"), 0U) << commands_->trouble();
  EXPECT_EQ(report().level, diagnostic_msgs::msg::DiagnosticStatus::ERROR);
  commands_->stopped("the node is disabled");
  EXPECT_EQ(commands_->trouble(), "stopped: the node is disabled");
}

TEST_F(Commands, TellWhatTakesLongerThanTheFilterWasTold) {
  use({});
  want({0.1, 0.2});
  sliding_.result.time.joints_age_s = 0.004;
  allowed();
  EXPECT_EQ(report().message, "filtered");
  sliding_.result.time.joints_age_s = 0.015;
  use({});
  want({0.1, 0.2});
  allowed();
  EXPECT_EQ(report().message, "joints were 15 ms old; filter.latency_s is 10 ms");
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  allowed();
  EXPECT_NE(report().message.find("filter.period_s is 10 ms"), std::string::npos);
}

}  // namespace
}  // namespace berth_ros
