// The monitor on the bundled scene: three cameras, a robot that moves, and faults in each input.
#include "berth/separation/monitor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/scene/open_scene.hpp"
#include "berth/separation/link_speed.hpp"
#include "berth/separation/near_link.hpp"
#include "berth/separation/protective_distance.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Taken within 34 ms.
constexpr std::array<std::size_t, 3> kImages = {5, 5, 4};

/// Without what hides the effect of a single input.
SeparationSettings plain_settings() {
  SeparationSettings settings;
  settings.acceleration_m_s2 = 0;
  settings.intrusion_m = 0.2;
  settings.least_seen = 0;
  settings.not_seen = settings.unknown = settings.rejected = UnknownPolicy::ignore;
  settings.no_reading = UnknownPolicy::ignore;
  return settings;
}

class Monitor : public ::testing::Test {
 protected:
  Monitor()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml")), query_(scene_.robot) {
    for (std::size_t c = 0; c < scene_.cameras.size(); ++c) {
      const OpenCamera& camera = scene_.cameras[c];
      Observer observer(camera.mounted);
      auto frame = std::make_shared<Frame>();
      observer.observe(camera.read_depth(kImages[c]), camera.at_exposure[kImages[c]], *frame);
      now_s_ = std::max(now_s_, frame->stamp_s);
      frames_.push_back(frame);
    }
    ask();
  }

  /// At now_s_, with the joints of that time.
  void ask() {
    scene_.joints->at(now_s_, kOnlyBetweenSamples, joints_);
    scene_.joints->velocity(now_s_, velocity_);
    result_ = query_.ask({frames_, joints_, now_s_});
  }

  /// Of a monitor that has just been made, without the way that the robot takes.
  Separation update(const SeparationSettings& settings) const {
    return SeparationMonitor(scene_.robot, settings).update(result_, velocity_, now_s_);
  }

  OpenScene scene_;
  Query query_;
  std::vector<std::shared_ptr<const Frame>> frames_;
  double now_s_ = 0;
  JointState joints_;
  std::vector<double> velocity_;
  Result result_;
};

TEST_F(Monitor, EachLinkHasTheRoomThatItsFormulaSays) {
  const SeparationSettings settings = plain_settings();
  const Separation separation = update(settings);
  ASSERT_EQ(separation.links.size(), 8U);
  EXPECT_NEAR(separation.reaction_time_s, settings.reaction_time_s + now_s_ - frames_[0]->stamp_s,
              1e-9)
      << "the oldest image counts";
  std::vector<LinkTwist> twists;
  RobotPose pose;
  forward_kinematics(scene_.robot->model(), joints_.position, pose);
  link_twists(scene_.robot->model(), pose, velocity_, twists);
  double least = 1;
  for (const LinkSeparation& link : separation.links) {
    if (!link.is_moved) continue;
    const std::size_t index = scene_.robot->model().evaluated_links[link.id - 1];
    const double speed_m_s = greatest_speed_m_s(
        hull_points(scene_.robot->model().links[index].mesh_L), pose.X_BL[index], twists[index]);
    EXPECT_NEAR(link.speed_m_s, speed_m_s, 1e-9);
    EXPECT_GT(link.speed_m_s, 0);
    EXPECT_NEAR(link.margin_m, link.distance_m - link.required_m, 1e-12);
    EXPECT_GE(link.distance_m, result_.links[link.id - 1].lower_bound_m);
    least = std::min(least, link.speed_scale);
  }
  EXPECT_EQ(separation.speed_scale, least < kLeastScale ? 0 : least);
}

TEST_F(Monitor, WhatTheCamerasMayMissByTheirSettingsCounts) {
  SeparationSettings settings = plain_settings();
  settings.intrusion_m.reset();
  settings.detection_m = 0.02;
  const LinkSeparation promised = update(settings).links.back();
  const double told_m =
      detection_capability_m(frames_[0]->mounted->settings().space, frames_[0]->mounted->camera());
  settings.detection_m = told_m;
  const LinkSeparation told = update(settings).links.back();
  EXPECT_GT(told_m, 0.02);
  EXPECT_EQ(promised.required_m, told.required_m);
}

TEST_F(Monitor, ALinkThatNoJointMovesNeedsNoRoom) {
  const Separation separation = update(plain_settings());
  EXPECT_FALSE(separation.links[0].is_moved);
  EXPECT_EQ(separation.links[0].speed_scale, 1);
  EXPECT_TRUE(std::isnan(separation.links[0].margin_m));
}

TEST_F(Monitor, SlowPeopleAndASmallReachLeaveTheRobotItsSpeed) {
  SeparationSettings settings = plain_settings();
  settings.human_speed_m_s = 0;
  settings.intrusion_m = 0;
  settings.camera_uncertainty_m = settings.robot_uncertainty_m = 0;
  settings.reaction_time_s = 0;
  settings.deceleration_m_s2 = 100;
  const Separation separation = update(settings);
  EXPECT_EQ(name_of(separation.state), "clear");
  EXPECT_EQ(separation.speed_scale, 1);
  EXPECT_EQ(name_of(separation.reason), "none");
  EXPECT_EQ(separation.link, kNoLink);
}

TEST_F(Monitor, TheDefaultsStopBesideSomethingNear) {
  SeparationSettings settings;
  settings.no_reading = UnknownPolicy::ignore;
  const Separation separation = update(settings);
  EXPECT_EQ(name_of(separation.state), "stop");
  EXPECT_EQ(separation.speed_scale, 0);
  EXPECT_NE(separation.link, kNoLink);
}

TEST_F(Monitor, WhereNobodyHasChosenWhatGivesNoReadingStopsTheRobot) {
  SeparationSettings settings = plain_settings();
  EXPECT_NE(name_of(update(settings).reason), "no_reading");
  settings.no_reading.reset();
  settings.contact_speed_m_s = 0.05;
  result_.cameras[0].tells_unread = true;
  const Separation stopped = update(settings);
  EXPECT_EQ(name_of(stopped.state), "stop");
  EXPECT_EQ(name_of(stopped.reason), "no_reading");
  EXPECT_EQ(stopped.camera, 1);
  settings.no_reading = UnknownPolicy::assume_range;
  settings.assumed_range_m = 0;
  EXPECT_EQ(name_of(update(settings).reason), "no_reading");
  for (CameraResult& camera : result_.cameras) camera.tells_unread = true;
  settings.no_reading.reset();
  EXPECT_NE(name_of(update(settings).reason), "no_reading");
  EXPECT_EQ(update(settings).camera, -1);
}

TEST_F(Monitor, AsksForNoChoiceWhereNoReadingMeansSomething) {
  for (const NoReading no_reading : kNoReadings) {
    CameraSettings settings = scene_.cameras[0].mounted->settings();
    settings.space.no_reading = no_reading;
    const auto mounted = std::make_shared<const MountedCamera>(
        scene_.robot, scene_.cameras[0].mounted->mount(), settings);
    auto frame = std::make_shared<Frame>();
    Observer(mounted).observe(scene_.cameras[0].read_depth(0), scene_.cameras[0].at_exposure[0],
                              *frame);
    EXPECT_EQ(frame->tells_unread, no_reading != NoReading::unknown);
    EXPECT_GE(frame->unread_share, 0);
    EXPECT_LT(frame->unread_share, 0.5);
  }
}

/// Settings that leave a scale between 0 and 1.
SeparationSettings reduced_settings() {
  SeparationSettings settings = plain_settings();
  settings.human_speed_m_s = 0.2;
  settings.intrusion_m = 0;
  settings.camera_uncertainty_m = settings.robot_uncertainty_m = 0;
  settings.deceleration_m_s2 = 0.4;
  return settings;
}

TEST_F(Monitor, TheScaleLeavesEachLinkItsRoom) {
  const Separation before = update(reduced_settings());
  ASSERT_EQ(name_of(before.state), "reduced") << before.speed_scale;
  for (double& v : velocity_) v *= before.speed_scale;
  const Separation after = update(reduced_settings());
  EXPECT_GT(after.speed_scale, 0.999);
  for (const LinkSeparation& link : after.links) {
    if (!link.is_moved) continue;
    EXPECT_GE(link.margin_m, -1e-5);
  }
  for (double& v : velocity_) v *= 1.05;
  EXPECT_LT(update(reduced_settings()).speed_scale, 1);
}

TEST_F(Monitor, WhatTheRobotMayGainInSpeedCounts) {
  SeparationSettings settings = reduced_settings();
  const Separation before = update(settings);
  settings.acceleration_m_s2 = 1;
  const Separation after = update(settings);
  EXPECT_NEAR(after.links[7].speed_m_s, before.links[7].speed_m_s + settings.reaction_time_s, 1e-9);
  EXPECT_LT(after.speed_scale, before.speed_scale);
}

TEST_F(Monitor, TheUncertaintyComesFromTheCamerasInUse) {
  SeparationSettings settings = plain_settings();
  const Separation automatic = update(settings);
  settings.camera_uncertainty_m = 0;
  const Separation none = update(settings);
  for (std::size_t i = 1; i < none.links.size(); ++i) {
    // Tolerance 5 cm, noise 2 cm at 1 m and 20 cm at 3 m.
    const double z_d_m = automatic.links[i].required_m - none.links[i].required_m;
    EXPECT_GE(z_d_m, 0.07 - 1e-9);
    EXPECT_LE(z_d_m, 0.25);
  }
}

TEST_F(Monitor, AnOldResultStops) {
  now_s_ += 0.2;
  ask();
  const Separation separation = update(plain_settings());
  EXPECT_EQ(name_of(separation.state), "stop");
  EXPECT_EQ(name_of(separation.reason), "stale");
  EXPECT_TRUE(std::isnan(separation.reaction_time_s));
  for (const LinkSeparation& link : separation.links) {
    EXPECT_EQ(link.speed_scale, link.is_moved ? 0 : 1);
  }
}

TEST_F(Monitor, AVelocityThatIsNotKnownStops) {
  SeparationSettings settings = reduced_settings();
  settings.human_speed_m_s = 0;
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity()}) {
    const std::vector<double> good = velocity_;
    velocity_[3] = bad;
    EXPECT_EQ(name_of(update(settings).reason), "velocity");
    EXPECT_EQ(name_of(update(settings).state), "stop");
    velocity_ = good;
  }
  velocity_.pop_back();
  EXPECT_EQ(name_of(update(settings).reason), "velocity") << "one is missing";
}

TEST_F(Monitor, APositionThatIsNotKnownStops) {
  JointBuffer joints(scene_.robot->model(), 2);
  result_ = query_.ask({frames_, joints, now_s_});
  EXPECT_EQ(result_.time.status, TimeStatus::no_joints);
  EXPECT_EQ(name_of(update(plain_settings()).state), "stop");
  EXPECT_EQ(name_of(update(plain_settings()).reason), "stale");
}

TEST_F(Monitor, ALostCameraGoesByItsPolicy) {
  frames_[1] = nullptr;
  ask();
  SeparationSettings settings = reduced_settings();
  settings.camera = UnknownPolicy::ignore;
  EXPECT_GT(update(settings).speed_scale, 0);
  settings.camera = UnknownPolicy::stop;
  const Separation stopped = update(settings);
  EXPECT_EQ(name_of(stopped.state), "stop");
  EXPECT_EQ(name_of(stopped.reason), "camera");
  EXPECT_EQ(stopped.camera, 1);
  settings.camera = UnknownPolicy::assume_range;
  settings.assumed_range_m = 0.1;
  const Separation assumed = update(settings);
  EXPECT_GT(assumed.speed_scale, 0);
  EXPECT_LE(assumed.speed_scale, stopped.speed_scale + 1);
  for (const LinkSeparation& link : assumed.links) {
    if (!link.is_moved) continue;
    EXPECT_LE(link.distance_m, 0.1);
  }
}

TEST_F(Monitor, ACoveredCameraIsALostOne) {
  const OpenCamera& camera = scene_.cameras[2];
  DepthImage dark = camera.read_depth(kImages[2]);
  for (float& depth_m : dark.pixels()) depth_m = std::numeric_limits<float>::quiet_NaN();
  auto covered = std::make_shared<Frame>();
  Observer(camera.mounted).observe(dark, camera.at_exposure[kImages[2]], *covered);
  frames_[2] = covered;
  ask();
  ASSERT_EQ(result_.cameras[2].status, CameraStatus::blind);
  EXPECT_EQ(name_of(update(plain_settings()).reason), "camera");
}

TEST_F(Monitor, TheScaleFallsAtOnceAndRisesAsTheMotorsLetTheRobotGainSpeed) {
  SeparationSettings settings = reduced_settings();
  settings.acceleration_m_s2 = 0.5;
  SeparationMonitor monitor(scene_.robot, settings);
  const double room = monitor.update(result_, velocity_, now_s_).speed_scale;
  ASSERT_GT(room, 0.2);
  const std::vector<double> unknown(velocity_.size(), kNaN);
  EXPECT_EQ(monitor.update(result_, unknown, now_s_ + 0.01).speed_scale, 0);
  const Separation rising = monitor.update(result_, velocity_, now_s_ + 0.05);
  EXPECT_EQ(name_of(rising.reason), "speeding_up");
  double fastest_m_s = 0;
  for (const LinkSeparation& link : rising.links) {
    if (link.is_moved) fastest_m_s = std::max(fastest_m_s, link.speed_m_s);
  }
  EXPECT_NEAR(rising.speed_scale, 0.04 * 0.5 / fastest_m_s, 1e-9);
  EXPECT_EQ(monitor.update(result_, velocity_, now_s_ + 5).speed_scale, room);
  EXPECT_EQ(monitor.update(result_, velocity_, now_s_).speed_scale, room)
      << "the clock was set back: no more than before";
}

TEST_F(Monitor, AContactSpeedLeavesTheRobotThatMuch) {
  SeparationSettings settings;
  settings.no_reading = UnknownPolicy::ignore;
  settings.contact_speed_m_s = 0.05;
  settings.not_seen = UnknownPolicy::ignore;
  ASSERT_EQ(result_.status, ResultStatus::ok);
  for (LinkResult& link : result_.links) link.status = LinkStatus::ok;
  const Separation separation = update(settings);
  EXPECT_EQ(name_of(separation.state), "contact_speed");
  double fastest_m_s = 0;
  for (const LinkSeparation& link : separation.links) {
    if (link.is_moved) fastest_m_s = std::max(fastest_m_s, link.speed_m_s);
  }
  EXPECT_NEAR(separation.speed_scale * fastest_m_s, 0.05, 1e-9);
  EXPECT_NE(name_of(separation.reason), "none");
}

TEST_F(Monitor, WhereSomethingIsNotInOrderNoContactIsTolerable) {
  SeparationSettings settings;
  settings.no_reading = UnknownPolicy::ignore;
  settings.contact_speed_m_s = 0.05;
  settings.not_seen = settings.camera = UnknownPolicy::ignore;
  for (LinkResult& link : result_.links) link.status = LinkStatus::ok;
  const Result healthy = result_;
  ASSERT_GT(update(settings).speed_scale, 0);
  result_.cameras[1].status = CameraStatus::blind;
  EXPECT_EQ(name_of(update(settings).state), "stop");
  result_ = healthy;
  result_.links[5].status = LinkStatus::not_seen;
  EXPECT_EQ(name_of(update(settings).state), "stop");
  result_ = healthy;
  result_.links[5].status = LinkStatus::cut_short;
  EXPECT_EQ(name_of(update(settings).state), "stop");
  result_ = healthy;
  velocity_[0] = kNaN;
  EXPECT_EQ(name_of(update(settings).state), "stop");
}

TEST_F(Monitor, WithSomethingSharpNoContactIsTolerable) {
  SeparationSettings settings;
  settings.no_reading = UnknownPolicy::ignore;
  settings.contact_speed_m_s = 0.05;
  settings.not_seen = UnknownPolicy::ignore;
  for (LinkResult& link : result_.links) link.status = LinkStatus::ok;
  for (const bool is_sharp : {false, true}) {
    const auto robot = attach(*scene_.robot, {.name = "blade",
                                              .link = scene_.robot->model().links.back().name,
                                              .mesh_A = scene_.robot->model().links.back().mesh_L,
                                              .is_sharp = is_sharp});
    const Separation separation =
        SeparationMonitor(robot, settings).update(result_, velocity_, now_s_);
    EXPECT_EQ(name_of(separation.state), is_sharp ? "stop" : "contact_speed");
  }
}

TEST_F(Monitor, AllocatesNothing) {
  // Along the robot's way some is shown and some is not.
  SeparationMonitor monitor(scene_.robot, reduced_settings());
  const auto ask_monitor = [&](int i) {
    return monitor.update(result_, velocity_, now_s_ + i, &query_.frames()).basis;
  };
  for (int i = 0; i < 3; ++i) ASSERT_EQ(ask_monitor(i), SeparationBasis::path);
  const std::size_t before = allocation_count();
  for (int i = 3; i < 6; ++i) ask_monitor(i);
  EXPECT_EQ(allocation_count(), before);
}

TEST_F(Monitor, NeedsARobotWhoseResultsTellWhatIsSeen) {
  EvaluationSettings evaluation;
  evaluation.visibility = false;
  const auto robot = std::make_shared<const Robot>(scene_.robot->model(), evaluation);
  EXPECT_EQ(error_message<std::invalid_argument>([&] { SeparationMonitor(robot, {}); }),
            "separation: visibility is off; expected on, since it tells which links are seen");
}

TEST_F(Monitor, RefusesBadSettings) {
  SeparationSettings settings;
  settings.reaction_time_s = -2;
  EXPECT_EQ(
      error_message<std::invalid_argument>([&] { SeparationMonitor(scene_.robot, settings); }),
      "separation.reaction_time_s: -2; expected a finite number of at least 0");
}

}  // namespace
}  // namespace berth
