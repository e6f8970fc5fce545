// Results in time, and those that are withheld: the clock is the test's own.
#include "berth/pipeline/timeliness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "berth/pipeline/observer.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/pipeline/frame_query.hpp"
#include "tests/support/mounted_with.hpp"

namespace berth {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kPeriod_s = 1.0 / 30;

std::vector<std::string> joint_names(const RobotModel& model) {
  std::vector<std::string> names;
  for (const MovableJoint& joint : model.joints) names.push_back(joint.name);
  return names;
}

/// A camera of 30 Hz and joints of 100 Hz that begin at 10 s.
class RunningRobot : public ::testing::Test {
 protected:
  RunningRobot()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()),
        depth_m_(camera_.read_depth(3)),
        mounted_(testing::mounted_with(*camera_.mounted, EvaluationSettings(), {})),
        names_(joint_names(mounted_->robot()->model())) {
    push_until(10.5);
  }

  void push_until(double stamp_s) {
    for (; next_s_ <= stamp_s; next_s_ += 0.01) {
      buffer_.push(next_s_, names_, camera_.at_exposure[3].position);
    }
  }
  TimeStatus observe(double stamp_s) {
    observer_.observe(depth_m_, stamp_s, buffer_, frame_);
    EXPECT_EQ(frame_.stamp_s, stamp_s);
    return frame_.time.status;
  }

  OpenScene scene_;
  const OpenCamera& camera_;
  DepthImage depth_m_;
  std::shared_ptr<const MountedCamera> mounted_;
  std::vector<std::string> names_;
  double next_s_ = 10;
  JointBuffer buffer_{mounted_->robot()->model(), 100};
  Observer observer_{mounted_};
  testing::FrameQuery query_{mounted_->robot()};
  Frame frame_;
};

bool all_ok(const Result& result) {
  for (const LinkResult& link : result.links) {
    if (link.status != LinkStatus::ok) return false;
  }
  return result.status == ResultStatus::ok && !result.links.empty();
}

void expect_withheld(const Result& result, TimeStatus status, int link_count) {
  EXPECT_EQ(result.status, ResultStatus::stale);
  EXPECT_EQ(result.time.status, status);
  EXPECT_EQ(result.nearest, -1);
  EXPECT_TRUE(result.pose.X_BL.empty());
  ASSERT_EQ(result.links.size(), static_cast<std::size_t>(link_count));
  for (int i = 0; i < link_count; ++i) {
    const LinkResult& link = result.links[i];
    EXPECT_EQ(link.id, i + 1);
    EXPECT_EQ(link.status, LinkStatus::stale);
    EXPECT_TRUE(std::isnan(link.distance_m) && std::isnan(link.lower_bound_m));
    EXPECT_TRUE(link.robot_point_C_m.hasNaN() && link.obstacle_point_C_m.hasNaN());
    EXPECT_TRUE(link.robot_point_B_m.hasNaN() && link.obstacle_point_B_m.hasNaN());
    EXPECT_FALSE(link.occupied.is_known());
  }
}

TEST_F(RunningRobot, AnAnswerInTimeHasItsAgesAndSkew) {
  ASSERT_EQ(observe(10.303), TimeStatus::ok);
  const Result& fresh =
      query_.ask(frame_, JointState{10.4, camera_.at_exposure[3].position}, 10.41);
  EXPECT_EQ(fresh.time.status, TimeStatus::ok);
  EXPECT_NEAR(fresh.time.frame_age_s, 0.107, 1e-9);
  EXPECT_NEAR(fresh.time.joints_age_s, 0.01, 1e-9);
  EXPECT_NEAR(fresh.time.skew_s, 0.003, 1e-9);
  EXPECT_TRUE(all_ok(fresh));
}

TEST_F(RunningRobot, TheAnswerIsThatOfTheSameJointsWithoutAnyClock) {
  ASSERT_EQ(observe(10.303), TimeStatus::ok);
  const Result timed = query_.ask(frame_, {}, 10.35);
  Frame plain;
  Observer(mounted_).observe(depth_m_, camera_.at_exposure[3], plain);
  const Result& untimed = query_.ask(plain);
  EXPECT_TRUE(std::isnan(untimed.time.frame_age_s));
  EXPECT_EQ(untimed.time.status, TimeStatus::ok);
  for (std::size_t i = 0; i < timed.links.size(); ++i) {
    EXPECT_FLOAT_EQ(timed.links[i].distance_m, untimed.links[i].distance_m);
  }
}

TEST_F(RunningRobot, AStaleFrameGivesNoAnswerHoweverOftenItIsAsked) {
  ASSERT_EQ(observe(10.2), TimeStatus::ok);
  EXPECT_TRUE(all_ok(query_.ask(frame_, {}, 10.349)));
  for (const double now_s : {10.351, 11.0, 1e9, kNaN}) {
    expect_withheld(query_.ask(frame_, {}, now_s), TimeStatus::stale_frame,
                    mounted_->robot()->model().link_count());
  }
  expect_withheld(query_.ask(frame_, {}, 10.194), TimeStatus::frame_in_future,
                  mounted_->robot()->model().link_count());
  EXPECT_TRUE(all_ok(query_.ask(frame_, {}, 10.349))) << "an earlier refusal leaves nothing behind";
}

TEST_F(RunningRobot, StaleJointsGiveNoAnswerAndPlannedOnesDo) {
  ASSERT_EQ(observe(10.4), TimeStatus::ok);
  EXPECT_TRUE(all_ok(query_.ask(frame_, buffer_, 10.51)));
  expect_withheld(query_.ask(frame_, buffer_, 10.53), TimeStatus::stale_joints,
                  mounted_->robot()->model().link_count());
  EXPECT_TRUE(all_ok(query_.ask(frame_, buffer_, 10.47))) << "between two ticks of a slow clock";
  expect_withheld(query_.ask(frame_, buffer_, 10.45), TimeStatus::stale_joints,
                  mounted_->robot()->model().link_count());
  const JointState planned{10.9, camera_.at_exposure[3].position};
  const Result& answer = query_.ask(frame_, planned, 10.45);
  EXPECT_NEAR(answer.time.joints_age_s, -0.45, 1e-9);
  EXPECT_TRUE(all_ok(answer));
}

TEST_F(RunningRobot, AnExposureThatTheJointsDoNotReachLeavesNothingOfTheFrameBefore) {
  ASSERT_EQ(observe(10.4), TimeStatus::ok);
  ASSERT_TRUE(all_ok(query_.ask(frame_)));
  EXPECT_EQ(observe(10.52), TimeStatus::extrapolated_too_far);
  expect_withheld(query_.ask(frame_), TimeStatus::extrapolated_too_far,
                  mounted_->robot()->model().link_count());
  expect_withheld(query_.ask(frame_, camera_.at_exposure[3]), TimeStatus::extrapolated_too_far,
                  mounted_->robot()->model().link_count());
  EXPECT_EQ(query_.ask(frame_).cameras[0].stamp_s, 10.52);
  for (const float z_m : frame_.obstacles.depth_m.pixels()) ASSERT_TRUE(std::isnan(z_m));
  for (const LinkId id : frame_.robot.link_id.pixels()) ASSERT_EQ(id, kNoLink);
  EXPECT_TRUE(frame_.X_BC.matrix().hasNaN());
  push_until(10.6);
  EXPECT_EQ(observe(10.55), TimeStatus::ok);
  EXPECT_TRUE(all_ok(query_.ask(frame_))) << "the next frame is whole again";
}

TEST_F(RunningRobot, AGapInTheJointsIsSkew) {
  next_s_ = 10.6;
  push_until(10.7);
  EXPECT_EQ(observe(10.51), TimeStatus::ok);
  EXPECT_EQ(observe(10.55), TimeStatus::skewed);
  EXPECT_NEAR(frame_.time.skew_s, 0.05, 0.011);
}

TEST_F(RunningRobot, StampsThatGoBackRepeatOrJumpCostTheirFrame) {
  next_s_ = 10.51;
  push_until(10.9);
  EXPECT_EQ(observe(10.3), TimeStatus::ok);
  EXPECT_EQ(observe(10.3), TimeStatus::stamp_went_back) << "the same image again";
  EXPECT_EQ(observe(10.2), TimeStatus::stamp_went_back);
  expect_withheld(query_.ask(frame_), TimeStatus::stamp_went_back,
                  mounted_->robot()->model().link_count());
  EXPECT_EQ(observe(10.2 + kPeriod_s), TimeStatus::ok) << "judged by the frame before alone";
  EXPECT_EQ(observe(1e9), TimeStatus::stamp_jumped);
  EXPECT_EQ(observe(10.4), TimeStatus::stamp_went_back);
  EXPECT_EQ(observe(10.4 + kPeriod_s), TimeStatus::ok);
  EXPECT_EQ(observe(-1e9), TimeStatus::stamp_went_back);
}

TEST_F(RunningRobot, AMissingJointIsTheStatusOfFramesAndRequests) {
  ASSERT_EQ(observe(10.4), TimeStatus::ok);
  const std::vector<std::string> fewer(names_.begin() + 1, names_.end());
  buffer_.push(10.52, fewer, std::vector<double>(fewer.size(), 0.0));
  EXPECT_EQ(buffer_.missing_joint(), names_.front());
  expect_withheld(query_.ask(frame_, buffer_, 10.45), TimeStatus::missing_joint,
                  mounted_->robot()->model().link_count());
  EXPECT_EQ(observe(10.52), TimeStatus::missing_joint);
  expect_withheld(query_.ask(frame_, {}, 10.53), TimeStatus::missing_joint,
                  mounted_->robot()->model().link_count());
  const JointBuffer empty(mounted_->robot()->model(), 2);
  expect_withheld(query_.ask(frame_, empty, 10.45), TimeStatus::no_joints,
                  mounted_->robot()->model().link_count());
}

TEST(FrameClock, AStampThatIsNoTimeTellsNothingOfTheNext) {
  FrameClock clock;
  EXPECT_EQ(clock.next(kNaN), TimeStatus::stamp_jumped);
  EXPECT_EQ(clock.next(5), TimeStatus::ok);
  EXPECT_EQ(clock.next(kNaN), TimeStatus::stamp_jumped);
  EXPECT_EQ(clock.next(6), TimeStatus::ok);
  EXPECT_EQ(clock.next(7.01), TimeStatus::stamp_jumped);
}

TEST(TimeSettings, LimitsBelowZeroAndNaNAreRefused) {
  const auto refused = [](auto change) {
    TimeSettings settings;
    for (const double value : {-0.1, kNaN}) {
      change(settings, value);
      EXPECT_THROW(validate(settings), std::invalid_argument) << value;
    }
    change(settings, std::numeric_limits<double>::infinity());
    EXPECT_NO_THROW(validate(settings));
  };
  refused([](TimeSettings& s, double v) { s.joints.max_skew_s = v; });
  refused([](TimeSettings& s, double v) { s.max_frame_age_s = v; });
  refused([](TimeSettings& s, double v) { s.max_joints_age_s = v; });
}

}  // namespace
}  // namespace berth
