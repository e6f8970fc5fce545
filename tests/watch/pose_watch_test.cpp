#include "berth/watch/pose_watch.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <vector>

#include "tests/support/error_message.hpp"

namespace berth {
namespace {

constexpr int kWidth_px = 40, kHeight_px = 30;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A robot that fills the image, 2 m before the camera, as one that is seen through, or hidden, to
/// this share.
class Watched {
 public:
  explicit Watched(const WatchSettings& settings, MeasureDisplacement measure = {},
                   const CameraWatch& before = {})
      : watch(settings, std::move(measure), before) {}

  const CameraWatch& look(double seen_through, double hidden = 0) {
    const auto pixels = static_cast<double>(depth_m_.pixels().size());
    const auto first = static_cast<std::size_t>(hidden * pixels);
    const auto second = first + static_cast<std::size_t>(seen_through * (pixels - first));
    for (std::size_t i = 0; i < depth_m_.pixels().size(); ++i) {
      depth_m_.pixels()[i] = i < first ? 1.0F : i < second ? 3.0F : 2.0F;
    }
    return watch.look(depth_m_, robot_, at_exposure);
  }
  const CameraWatch& look_at_nothing() {
    return watch.look(DepthImage(kWidth_px, kHeight_px, kNoDepth), robot_, at_exposure);
  }

  PoseWatch watch;
  JointState at_exposure{0, {0.5}};

 private:
  DepthImage depth_m_{kWidth_px, kHeight_px, 2.0F};
  RobotImage robot_{DepthImage(kWidth_px, kHeight_px, 2.0F),
                    Image<LinkId>(kWidth_px, kHeight_px, 1)};
};

const WatchSettings kBySeenThrough{.max_seen_through = 0.1, .agreeing_frames = 3, .frames = 4};
const WatchSettings kByDisplacement{.max_displacement_m = 0.015, .check_every_s = 0.4};

TEST(PoseWatch, HasMovedOnceKOfNFramesSayItAndIsBackOnceKDoNot) {
  Watched camera(kBySeenThrough);
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(camera.look(0.05).has_moved);
  EXPECT_FALSE(camera.look(0.2).has_moved);
  EXPECT_FALSE(camera.look(0.2).has_moved);
  const CameraWatch& moved = camera.look(0.2);
  EXPECT_TRUE(moved.has_moved);
  EXPECT_TRUE(moved.is_on);
  EXPECT_NEAR(moved.seen_through, 0.2, 1e-3);
  EXPECT_TRUE(std::isnan(moved.displacement_m));
  EXPECT_TRUE(camera.look(0.05).has_moved);
  EXPECT_TRUE(camera.look(0.05).has_moved);
  EXPECT_FALSE(camera.look(0.05).has_moved);
}

TEST(PoseWatch, OneThatBeginsWithAMovedCameraGoesByItUntilKOfNFramesDoNot) {
  const CameraWatch moved{.is_on = true, .has_moved = true, .seen_through = 0.2};
  Watched camera(kBySeenThrough, {}, moved);
  EXPECT_TRUE(camera.look_at_nothing().has_moved);
  EXPECT_TRUE(camera.watch.pass_over().has_moved);
  EXPECT_TRUE(camera.look(0.05).has_moved);
  EXPECT_TRUE(camera.look(0.05).has_moved);
  EXPECT_FALSE(camera.look(0.05).has_moved);
  EXPECT_FALSE(Watched({}, {}, moved).look(0.2).has_moved) << "nobody looks any more";
}

TEST(PoseWatch, OneThatBeginsWithAnImplausibleCameraNeedsMoreThanOneFrame) {
  const WatchSettings settings{.min_at_robot = 0.1, .agreeing_frames = 3, .frames = 4};
  Watched camera(settings, {}, {.is_implausible = true});
  EXPECT_TRUE(camera.look_at_nothing().is_implausible);
  EXPECT_TRUE(camera.look(0).is_implausible);
  EXPECT_TRUE(camera.look(0).is_implausible);
  EXPECT_FALSE(camera.look(0).is_implausible);
}

TEST(PoseWatch, ARobotThatIsNotThereIsImplausibleFromTheFirstFrameOn) {
  Watched camera({.min_at_robot = 0.1, .agreeing_frames = 3, .frames = 4});
  EXPECT_FALSE(camera.look_at_nothing().is_implausible);
  const CameraWatch& state = camera.look(0.95);
  EXPECT_TRUE(state.is_implausible);
  EXPECT_FALSE(state.is_trusted());
  EXPECT_FALSE(state.has_moved);
  EXPECT_FALSE(state.is_on);
  EXPECT_NEAR(state.at_robot, 0.05, 1e-3);
  EXPECT_TRUE(camera.look(0.5).is_implausible);
  EXPECT_TRUE(camera.look(0.5).is_implausible);
  EXPECT_FALSE(camera.look(0.5).is_implausible);
}

TEST(PoseWatch, OneThatWasPlausibleIsImplausibleOnceKOfNFramesSayIt) {
  Watched camera({.min_at_robot = 0.1, .agreeing_frames = 3, .frames = 4});
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(camera.look(0.85).is_implausible);
  EXPECT_FALSE(camera.look(1).is_implausible);
  EXPECT_FALSE(camera.look(1).is_implausible);
  EXPECT_TRUE(std::isnan(camera.watch.pass_over().at_robot));
  EXPECT_TRUE(camera.look(1).is_implausible);
}

TEST(PoseWatch, ARobotThatIsHiddenIsNotImplausible) {
  Watched camera({.min_at_robot = 0.1});
  EXPECT_TRUE(camera.look(1, 0.9).is_hidden);
  EXPECT_FALSE(camera.look(1, 0.9).is_implausible);
  EXPECT_TRUE(std::isnan(camera.look(1, 0.9).at_robot));
  EXPECT_FALSE(camera.look(0, 0.5).is_hidden);
  EXPECT_NEAR(camera.look(0, 0.5).at_robot, 1, 1e-9);
  camera.look(0, 0.9);
  EXPECT_FALSE(camera.watch.pass_over().is_hidden);
}

TEST(PoseWatch, WithTheLimitAtZeroNothingIsImplausible) {
  Watched camera({.min_at_robot = 0});
  EXPECT_FALSE(camera.look(1).is_implausible);
  EXPECT_TRUE(std::isnan(camera.look(1).at_robot));
  EXPECT_FALSE(camera.look(1, 0.9).is_hidden);
}

TEST(PoseWatch, AFrameThatSaysNothingNeitherRaisesNorClears) {
  Watched camera(kBySeenThrough);
  const auto say_nothing = [&] {
    EXPECT_TRUE(std::isnan(camera.look_at_nothing().seen_through));
    EXPECT_TRUE(std::isnan(camera.look(0.5, 0.85).seen_through)) << "hidden but for an outline";
    EXPECT_TRUE(std::isnan(camera.watch.pass_over().seen_through));
  };
  for (const bool has_moved : {true, false, true}) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 10; ++k) say_nothing();
      EXPECT_NE(camera.watch.pass_over().has_moved, has_moved);
      camera.look(has_moved ? 0.2 : 0.05);
    }
    EXPECT_EQ(camera.watch.pass_over().has_moved, has_moved);
  }
}

TEST(PoseWatch, JudgesWhatAPersonLeavesOfTheArm) {
  Watched camera(kBySeenThrough);
  for (int i = 0; i < 3; ++i) camera.look(0.2, 0.75);
  EXPECT_TRUE(camera.look(0.2, 0.75).has_moved);
  EXPECT_NEAR(camera.look(0.2, 0.75).seen_through, 0.2, 0.01);
}

TEST(PoseWatch, OffItSaysNothing) {
  Watched camera(WatchSettings{});
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(camera.look(0.9).has_moved);
  EXPECT_FALSE(camera.look(0.9).is_on);
  EXPECT_TRUE(std::isnan(camera.look(0.9).seen_through));
}

/// Gives one number after another; NaN is none.
struct Displacements {
  std::vector<double> values_m;
  std::vector<double> stamps_s;

  MeasureDisplacement function() {
    return [this](DepthView, const JointState& at_exposure, const Pose&, std::stop_token) {
      const double value_m = values_m[stamps_s.size() % values_m.size()];
      stamps_s.push_back(at_exposure.stamp_s);
      return std::isnan(value_m) ? std::nullopt : std::optional(value_m);
    };
  }
};

TEST(PoseWatch, TwoOfThreeDisplacementsRaiseAndClear) {
  Displacements measured{{0.02, 0.001, 0.02, kNaN, 0.02, 0.001, kNaN, 0.001}, {}};
  Watched camera(kByDisplacement, measured.function());
  const bool expected[] = {false, false, true, true, true, true, true, false};
  for (int i = 0; i < 8; ++i) {
    camera.at_exposure.stamp_s = 0.5 * i;
    camera.look(0);
    const CameraWatch& state = camera.watch.wait();
    EXPECT_EQ(state.has_moved, expected[i]) << i;
    const double last_m = measured.values_m[i];
    EXPECT_EQ(state.displacement_m, std::isnan(last_m) ? measured.values_m[i - 1] : last_m) << i;
  }
}

TEST(PoseWatch, MeasuresADisplacementOnceInItsTimeWhereEnoughOfTheRobotIsSeen) {
  Displacements measured{{0.001}, {}};
  Watched camera(kByDisplacement, measured.function());
  for (int frame = 0; frame < 60; ++frame) {
    camera.at_exposure.stamp_s = frame / 30.0;
    camera.look(0, frame >= 20 && frame < 40 ? 0.45 : 0.35);
    camera.watch.wait();
  }
  EXPECT_EQ(measured.stamps_s, (std::vector{0.0, 12 / 30.0, 40 / 30.0, 52 / 30.0}));
  camera.at_exposure.stamp_s = 0;
  camera.look(0);
  camera.watch.wait();
  EXPECT_EQ(measured.stamps_s.size(), 5U) << "a recording that begins anew";
}

TEST(PoseWatch, ARobotThatIsNearerThanItShouldBeIsNoHiddenOne) {
  Displacements measured{{0.1}, {}};
  PoseWatch watch(kByDisplacement, measured.function());
  const RobotImage robot{DepthImage(kWidth_px, kHeight_px, 2.0F),
                         Image<LinkId>(kWidth_px, kHeight_px, 1)};
  watch.look(DepthImage(kWidth_px, kHeight_px, 1.9F), robot, {0, {}});
  EXPECT_EQ(watch.wait().displacement_m, 0.1);
}

/// One that is held up until it is let go.
class SlowMeasurement {
 public:
  MeasureDisplacement function() {
    return [this](DepthView depth_m, const JointState& at_exposure, const Pose&,
                  std::stop_token stop) -> std::optional<double> {
      std::unique_lock lock(mutex_);
      has_begun = true;
      changed_.notify_all();
      was_let_go = changed_.wait(lock, stop, [this] { return lets_go_; });
      return 10 * depth_m(0, 0) + at_exposure.position[0];
    };
  }
  void let_go() {
    const std::lock_guard lock(mutex_);
    lets_go_ = true;
    changed_.notify_all();
  }
  void wait_for_begin() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return has_begun; });
  }

  bool has_begun = false;
  bool was_let_go = false;

 private:
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool lets_go_ = false;
};

TEST(PoseWatch, AFrameIsMeasuredFromItsOwnCopyWhileOthersGoOn) {
  SlowMeasurement slow;
  WatchSettings settings = kByDisplacement;
  settings.check_every_s = 0;
  Watched camera(settings, slow.function());
  camera.look(0);
  slow.wait_for_begin();
  camera.at_exposure = {1, {0.75}};
  EXPECT_TRUE(std::isnan(camera.look(1).displacement_m)) << "does not wait";
  slow.let_go();
  EXPECT_EQ(camera.watch.wait().displacement_m, 20.5) << "depth and joints of the first frame";
}

TEST(PoseWatch, EndsAtOnceInTheMidstOfAMeasurement) {
  SlowMeasurement slow;
  {
    Watched camera(kByDisplacement, slow.function());
    camera.look(0);
    slow.wait_for_begin();
  }
  EXPECT_TRUE(slow.has_begun);
  EXPECT_FALSE(slow.was_let_go);
  { const Watched never_used(kByDisplacement, slow.function()); }
}

TEST(PoseWatch, RefusesBadSettings) {
  expect_parts(error_message<std::invalid_argument>([] { PoseWatch watch(kByDisplacement); }),
               {"watch.max_displacement_m: 0.015", "expected 0"});
  expect_parts(error_message<std::invalid_argument>([] { PoseWatch watch({.frames = 0}); }),
               {"more than half of watch.frames, 0"});
}

}  // namespace
}  // namespace berth
