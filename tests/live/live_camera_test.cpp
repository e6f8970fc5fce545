#include "berth/live/live_camera.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "berth/pipeline/observer.hpp"
#include "tests/live/live_scene.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

constexpr double kPatient_s = 30;

class Live : public ::testing::Test {
 protected:
  Live() : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")) {}

  void start(const LiveCameraSettings& settings, LiveCamera::OnFrame on_frame = {},
             FindPlace find_place = {}, const CameraWatch& before = {}) {
    camera_.emplace(source().mounted, joints_, settings, std::move(on_frame), std::move(find_place),
                    before);
  }
  const OpenCamera& source() const { return scene_.cameras.front(); }
  double stamp_s(std::size_t i) const { return source().source.stamps_s[i]; }
  void push(std::size_t i) { camera_->push(stamp_s(i), source().read_depth(i)); }
  void push_joints_until(double time_s) {
    push_joints(scene_,
                joints_.buffer().newest_stamp_s() > 0 ? joints_.buffer().newest_stamp_s() : -1,
                time_s, joints_);
    camera_->look_again();
  }
  bool observed(std::int64_t images) {
    return comes_true([&] { return camera_->counts().images >= images; });
  }

  OpenScene scene_;
  JointIntake joints_{scene_.robot->model(), {}};
  std::optional<LiveCamera> camera_;
};

TEST_F(Live, AnImageWaitsForTheJointsAfterItsExposure) {
  start({.max_wait_s = kPatient_s});
  push_joints_until(stamp_s(2) - 0.005);
  push(2);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(camera_->counts().images, 0);
  EXPECT_FALSE(camera_->newest());
  push_joints_until(stamp_s(3));
  ASSERT_TRUE(observed(1));
  const auto frame = camera_->newest();
  EXPECT_EQ(frame->time.status, TimeStatus::ok);
  EXPECT_EQ(frame->stamp_s, stamp_s(2));
  EXPECT_GE(camera_->counts().longest_wait_s, 0.05);

  Observer observer(source().mounted);
  Frame expected;
  observer.observe(source().read_depth(2), source().at_exposure[2], expected);
  EXPECT_EQ(frame->obstacles.count, expected.obstacles.count);
  EXPECT_TRUE(frame->X_BC.isApprox(expected.X_BC, 1e-12));
}

TEST_F(Live, AnImageThatWaitedTooLongSaysSo) {
  start({.max_wait_s = 0.01});
  push(0);
  ASSERT_TRUE(observed(1));
  EXPECT_EQ(camera_->newest()->time.status, TimeStatus::no_joints);
  push_joints_until(stamp_s(1) - 0.02);
  push(1);
  ASSERT_TRUE(observed(2));
  EXPECT_EQ(camera_->newest()->time.status, TimeStatus::extrapolated_too_far);
  EXPECT_EQ(camera_->counts().stale, 2);
  push_joints_until(stamp_s(3));
  push(2);
  ASSERT_TRUE(observed(3));
  EXPECT_EQ(camera_->newest()->time.status, TimeStatus::ok) << "and goes on once joints come";
}

TEST_F(Live, AnImageWaitsForThePlaceOfItsCamera) {
  Pose X_PC = source().mounted->mount().X_PC;
  X_PC.translation().x() += 0.1;
  std::atomic<bool> is_known = false;
  start({.max_wait_s = kPatient_s}, {},
        [&](double) { return is_known ? std::optional(PlaceAtExposure{X_PC}) : std::nullopt; });
  push_joints_until(stamp_s(3));
  push(2);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(camera_->newest());
  is_known = true;
  camera_->look_again();
  ASSERT_TRUE(observed(1));
  EXPECT_EQ(camera_->newest()->time.status, TimeStatus::ok);
  EXPECT_EQ(camera_->newest()->X_PC.matrix(), X_PC.matrix());
}

TEST_F(Live, AnImageWhosePlaceDoesNotBecomeKnownSaysSo) {
  start({.max_wait_s = 0.01}, {}, [](double) { return std::optional<PlaceAtExposure>(); });
  push_joints_until(stamp_s(3));
  push(2);
  ASSERT_TRUE(observed(1));
  EXPECT_EQ(camera_->newest()->time.status, TimeStatus::stale_pose);
  EXPECT_EQ(camera_->counts().stale, 1);
}

TEST_F(Live, ImagesThatComeFasterThanTheirJointsAreObservedAllTheSame) {
  start({.max_wait_s = kPatient_s});
  for (std::size_t i = 0; i < kMostWaitingImages + 2; ++i) push(i);
  push_joints_until(stamp_s(0) + 0.01);
  ASSERT_TRUE(observed(1));
  EXPECT_EQ(camera_->newest()->stamp_s, stamp_s(0));
}

TEST_F(Live, OfImagesThatWaitThoseBeforeTheNewestAreDropped) {
  start({.max_wait_s = kPatient_s});
  for (std::size_t i = 0; i < kMostWaitingImages + 2; ++i) push(i);
  EXPECT_EQ(camera_->counts().dropped, 2);
  push_joints_until(10);
  EXPECT_TRUE(comes_true([&] {
    const auto newest = camera_->newest();
    return newest && newest->stamp_s == stamp_s(kMostWaitingImages + 1);
  }));
  EXPECT_EQ(camera_->counts().stale, 0);
}

TEST_F(Live, OfImagesThatAreReadyTheNewestIsObserved) {
  std::vector<double> stamps_s;
  start({.max_wait_s = kPatient_s}, [&](const std::shared_ptr<const Frame>& frame, const auto&...) {
    stamps_s.push_back(frame->stamp_s);
    if (stamps_s.size() > 1) return;
    for (const std::size_t i : {1, 2, 3}) push(i);
  });
  push_joints_until((stamp_s(2) + stamp_s(3)) / 2);
  push(0);
  ASSERT_TRUE(observed(2));
  EXPECT_EQ(camera_->counts().dropped, 1);
  push_joints_until(10);
  ASSERT_TRUE(observed(3));
  camera_.reset();
  EXPECT_EQ(stamps_s, (std::vector{stamp_s(0), stamp_s(2), stamp_s(3)}));
}

TEST_F(Live, AnImageThatComesTwiceAndOneFromBeforeAreNoNewFrames) {
  push_joints(scene_, -1, 10, joints_);
  start({.max_wait_s = kPatient_s});
  const auto status_of = [&](std::size_t i, int count) {
    push(i);
    EXPECT_TRUE(observed(count));
    return camera_->newest()->time.status;
  };
  EXPECT_EQ(status_of(1, 1), TimeStatus::ok);
  EXPECT_EQ(status_of(1, 2), TimeStatus::stamp_went_back);
  EXPECT_EQ(status_of(2, 3), TimeStatus::ok);
  EXPECT_EQ(status_of(0, 4), TimeStatus::stamp_went_back);
  EXPECT_EQ(status_of(1, 5), TimeStatus::ok) << "the clock was set back: one frame is lost";
}

TEST_F(Live, TheClocksOffsetIsHeeded) {
  push_joints(scene_, -1, 10, joints_);
  start({.clock_offset_s = 0.25, .max_wait_s = kPatient_s});
  push(0);
  ASSERT_TRUE(observed(1));
  const auto frame = camera_->newest();
  EXPECT_EQ(frame->stamp_s, stamp_s(0));
  JointState expected;
  joints_.buffer().at(stamp_s(0) + 0.25, kOnlyBetweenSamples, expected);
  RobotPose pose;
  forward_kinematics(scene_.robot->model(), expected.position, pose);
  EXPECT_TRUE(frame->pose.X_BL.back().isApprox(pose.X_BL.back(), 1e-12));
}

TEST_F(Live, ADistrustedCameraIsImplausibleUntilItIsTrusted) {
  push_joints(scene_, -1, 10, joints_);
  start({.max_wait_s = kPatient_s});
  const auto is_implausible = [&](std::size_t i) {
    push(i);
    EXPECT_TRUE(observed(i + 1));
    return camera_->newest()->watch.is_implausible;
  };
  EXPECT_FALSE(is_implausible(0));
  camera_->distrust(true);
  EXPECT_TRUE(is_implausible(1));
  EXPECT_TRUE(is_implausible(2));
  camera_->distrust(false);
  EXPECT_FALSE(is_implausible(3));
}

TEST_F(Live, WhatACameraWasFoundToBeHoldsForTheOneMadeAnew) {
  start({}, {}, {}, {.is_implausible = true});
  push_joints_until(stamp_s(3));
  push(2);
  ASSERT_TRUE(observed(1));
  EXPECT_TRUE(camera_->newest()->watch.is_implausible);
}

TEST_F(Live, AnImageThatAnExceptionEndsIsCountedAndTheNextGoesOn) {
  std::atomic<bool> throws = true;
  start({}, [&](const auto&, DepthView, const auto&) {
    if (throws) throw std::runtime_error("no place for it");
  });
  push_joints_until(stamp_s(4));
  push(2);
  ASSERT_TRUE(comes_true([&] { return camera_->counts().failed == 1; }));
  EXPECT_EQ(camera_->counts().failure, "no place for it");
  throws = false;
  push(3);
  ASSERT_TRUE(observed(2));
  EXPECT_EQ(camera_->counts().failure, "");
  EXPECT_EQ(camera_->newest()->stamp_s, stamp_s(3));
}

TEST_F(Live, FramesAreKeptForWhoHoldsThemAndUsedAgainAfterwards) {
  push_joints(scene_, -1, 10, joints_);
  start({.max_wait_s = kPatient_s});
  std::vector<std::shared_ptr<const Frame>> held;
  for (std::size_t i = 0; i < 6; ++i) {
    push(i);
    ASSERT_TRUE(observed(i + 1));
    held.push_back(camera_->newest());
  }
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(held[i]->stamp_s, stamp_s(i));
  const Frame* last = held.back().get();
  held.clear();
  for (std::size_t i = 6; i < 9; ++i) {
    push(i);
    ASSERT_TRUE(observed(i + 1));
    held.push_back(camera_->newest());
  }
  camera_.reset();
  EXPECT_EQ(held.back()->stamp_s, stamp_s(8)) << "also when the camera is gone";
  EXPECT_NE(held.front().get(), last) << "the newest one was not written over";
}

TEST_F(Live, OnFrameHasTheImageAndWhatCameWithIt) {
  push_joints(scene_, -1, 10, joints_);
  std::atomic<int> seen = 0;
  start({.max_wait_s = kPatient_s},
        [&](const std::shared_ptr<const Frame>& frame, DepthView depth_m,
            const std::shared_ptr<const void>& with) {
          EXPECT_EQ(frame->stamp_s, stamp_s(4));
          EXPECT_EQ(depth_m.width, source().mounted->camera().width_px);
          EXPECT_EQ(*std::static_pointer_cast<const int>(with), 44);
          ++seen;
        });
  DepthImage depth_m = camera_->spare_image();
  depth_m = source().read_depth(4);
  camera_->push(stamp_s(4), std::move(depth_m), std::make_shared<const int>(44));
  EXPECT_TRUE(comes_true([&] { return seen == 1; }));
}

TEST_F(Live, ItEndsAtOnceWhileImagesWait) {
  start({.max_wait_s = kPatient_s});
  push(0);
  const auto begin = std::chrono::steady_clock::now();
  camera_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST_F(Live, WrongUseIsRefused) {
  const auto expect = [&](const LiveCameraSettings& settings,
                          const std::vector<std::string>& parts) {
    expect_parts(error_message<std::invalid_argument>([&] { start(settings); }), parts);
  };
  expect({.max_wait_s = -1}, {"max_wait_s", "-1", "0 to 60"});
  expect({.max_wait_s = std::numeric_limits<double>::infinity()}, {"max_wait_s", "inf"});
  expect({.clock_offset_s = std::numeric_limits<double>::quiet_NaN()}, {"clock_offset_s", "nan"});
  start({});
  EXPECT_THROW(camera_->push(0, DepthImage(3, 3)), std::invalid_argument);
}

}  // namespace
}  // namespace berth
