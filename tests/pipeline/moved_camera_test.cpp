// A camera that does not stand where it should: its frames are not used.
#include <gtest/gtest.h>

#include <cmath>

#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/pipeline/frame_query.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/mounted_with.hpp"

namespace berth {
namespace {

constexpr std::size_t kFrame = 17;

class MovedCamera : public ::testing::Test {
 protected:
  MovedCamera()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()),
        robot_(std::make_shared<const Robot>(scene_.robot->model())),
        depth_m_(camera_.read_depth(kFrame)) {}

  /// As the bundled camera, but believed to be turned by so much.
  std::shared_ptr<const MountedCamera> view_of(double turn_rad,
                                               const WatchSettings& watch = kEachFrame) const {
    CameraMount mount = camera_.mounted->mount();
    mount.X_PC.rotate(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitY()));
    CameraSettings settings;
    settings.watch = watch;
    return std::make_shared<const MountedCamera>(robot_, mount, settings);
  }
  Frame& observe(Observer& observer, Frame& frame, FrameTime time = {}) const {
    observer.observe(depth_m_, camera_.at_exposure[kFrame], frame, time);
    return frame;
  }
  static void expect_withheld(const Result& result, TimeStatus status = TimeStatus::camera_moved) {
    EXPECT_EQ(result.status, ResultStatus::stale);
    EXPECT_EQ(result.time.status, status) << name_of(result.time.status);
    ASSERT_FALSE(result.links.empty());
    for (const LinkResult& link : result.links) {
      EXPECT_EQ(link.status, LinkStatus::stale);
      EXPECT_TRUE(std::isnan(link.distance_m));
    }
  }

  static constexpr WatchSettings kEachFrame{
      .max_seen_through = 0.03, .agreeing_frames = 1, .frames = 1};
  static constexpr double kTurn_rad = 0.05;

  OpenScene scene_;
  const OpenCamera& camera_;
  std::shared_ptr<const Robot> robot_;
  DepthImage depth_m_;
};

TEST_F(MovedCamera, NobodyIsAnsweredFromItsFrame) {
  Observer observer(view_of(kTurn_rad));
  Frame frame;
  observe(observer, frame);
  EXPECT_TRUE(frame.watch.has_moved);
  EXPECT_GT(frame.watch.seen_through, 0.1);
  testing::FrameQuery query(robot_);
  expect_withheld(query.ask(frame));
  expect_withheld(query.ask(frame, {}, frame.stamp_s + 0.01));
  expect_withheld(query.ask(frame, {}, frame.stamp_s + 10));
  expect_withheld(query.ask(frame, camera_.at_exposure[3]));
}

TEST_F(MovedCamera, NorFromOneThatIsImplausible) {
  // Without a limit that somebody set.
  Observer observer(view_of(1.2, {}));
  Frame frame;
  DepthImage far_m = depth_m_;
  for (float& z_m : far_m.pixels()) z_m *= 10;
  observer.observe(far_m, camera_.at_exposure[kFrame], frame);
  EXPECT_FALSE(frame.watch.is_implausible) << "no robot in the image, no verdict";
  Observer other(view_of(0, {}));
  other.observe(far_m, camera_.at_exposure[kFrame], frame);
  EXPECT_TRUE(frame.watch.is_implausible);
  testing::FrameQuery query(robot_);
  expect_withheld(query.ask(frame), TimeStatus::camera_implausible);
  expect_withheld(query.ask(frame, {}, frame.stamp_s + 0.01), TimeStatus::camera_implausible);
  EXPECT_EQ(camera_state(&frame, frame.stamp_s, {}).status, CameraStatus::implausible);
}

TEST_F(MovedCamera, OneThatStandsAsItShouldAnswersAsIfNobodyWatched) {
  Observer watched(view_of(0)), plain(view_of(0, {}));
  Frame frame, plain_frame;
  observe(watched, frame);
  observe(plain, plain_frame);
  EXPECT_TRUE(frame.watch.is_on);
  EXPECT_FALSE(frame.watch.has_moved);
  EXPECT_LT(frame.watch.seen_through, 0.02);
  EXPECT_FALSE(plain_frame.watch.is_on);
  testing::FrameQuery one(robot_), other(robot_);
  const Result& a = one.ask(frame);
  const Result& b = other.ask(plain_frame);
  for (std::size_t i = 0; i < a.links.size(); ++i) {
    EXPECT_EQ(a.links[i].distance_m, b.links[i].distance_m);
  }
}

TEST_F(MovedCamera, TheOthersAnswerStands) {
  Observer good(view_of(0)), bumped(view_of(kTurn_rad));
  Frame left, right;
  observe(good, left);
  observe(bumped, right);
  const std::vector<const Frame*> both = {&right, &left};
  Query a(robot_), b(robot_);
  const Result& result = a.ask({.frames = both, .now_s = left.stamp_s});
  const Result& expected = b.ask({.frames = left, .now_s = left.stamp_s});
  EXPECT_EQ(result.cameras[0].status, CameraStatus::moved);
  EXPECT_GT(result.cameras[0].watch.seen_through, 0.1);
  EXPECT_EQ(result.cameras[1].status, CameraStatus::ok);
  EXPECT_EQ(a.frames().used(), std::vector{1});
  EXPECT_EQ(result.status, ResultStatus::degraded);
  EXPECT_EQ(result.time.status, TimeStatus::ok);
  for (std::size_t i = 0; i < result.links.size(); ++i) {
    EXPECT_EQ(result.links[i].distance_m, expected.links[i].distance_m);
    EXPECT_EQ(result.links[i].camera, 1) << "by its place among the cameras of the request";
  }
  const std::vector<const Frame*> moved = {&right, nullptr};
  expect_withheld(a.ask({.frames = moved, .now_s = right.stamp_s}));
}

TEST_F(MovedCamera, AStaleFrameSaysWhatIsWrongWithItsTime) {
  Observer observer(view_of(kTurn_rad));
  Frame frame;
  observe(observer, frame);
  FrameTime skewed;
  skewed.status = TimeStatus::skewed;
  observe(observer, frame, skewed);
  EXPECT_TRUE(frame.watch.has_moved) << "no frame cleared it";
  EXPECT_TRUE(std::isnan(frame.watch.seen_through));
  const CameraState state = camera_state(&frame, frame.stamp_s, {});
  EXPECT_EQ(state.status, CameraStatus::stale);
  EXPECT_EQ(state.time, TimeStatus::skewed);
  Query query(robot_);
  EXPECT_EQ(query.ask({frame}).time.status, TimeStatus::skewed);
}

TEST_F(MovedCamera, TheDisplacementIsToldOnceItIsFinished) {
  const WatchSettings settings{.max_displacement_m = 0.02, .check_every_s = 0};
  double measured_m = 0.05;
  Observer observer(view_of(0, settings), [&](DepthView depth_m, const JointState& at_exposure,
                                              const Pose&, std::stop_token) {
    EXPECT_EQ(depth_m.width, 640);
    EXPECT_EQ(at_exposure.stamp_s, camera_.at_exposure[kFrame].stamp_s);
    return std::optional(measured_m);
  });
  Frame frame;
  for (const bool has_moved : {false, true}) {
    observe(observer, frame);
    observer.finish_watch(frame);
    EXPECT_EQ(frame.watch.has_moved, has_moved);
    EXPECT_EQ(frame.watch.displacement_m, 0.05);
  }
  testing::FrameQuery query(robot_);
  expect_withheld(query.ask(frame));
  measured_m = 0.001;
  for (const bool has_moved : {true, false}) {
    observe(observer, frame);
    observer.finish_watch(frame);
    EXPECT_EQ(frame.watch.has_moved, has_moved);
  }
}

TEST_F(MovedCamera, NothingIsLearnedFromIt) {
  for (const double turn_rad : {0.0, kTurn_rad}) {
    const auto mounted = view_of(turn_rad);
    CameraSettings settings = mounted->settings();
    settings.sensor.background_frames = 1;
    Observer observer(testing::mounted_with(*mounted, settings));
    Frame frame;
    observer.observe(depth_m_, camera_.at_exposure[kFrame], frame);
    observer.learn_background(depth_m_, frame);
    // Without a reading, what was learned stands where the robot is now.
    observer.observe(camera_.read_depth(0), camera_.at_exposure[0], frame);
    EXPECT_EQ(frame.obstacles.count_of(PixelFate::background) > 0, turn_rad == 0);
  }
}

TEST_F(MovedCamera, BadSettingsAreRefusedByTheView) {
  const auto refusal = [&](const WatchSettings& watch) {
    return error_message<std::invalid_argument>([&] { Observer observer(view_of(0, watch)); });
  };
  expect_parts(refusal({.max_seen_through = 2}), {"watch.max_seen_through: 2"});
  expect_parts(refusal({.max_displacement_m = -0.02}), {"watch.max_displacement_m: -0.02"});
}

}  // namespace
}  // namespace berth
