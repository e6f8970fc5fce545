// Frames at the camera's clock, requests at the controller's.
#include <gtest/gtest.h>

#include <thread>

#include "berth/pipeline/observer.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/pipeline/frame_query.hpp"
#include "tests/support/mounted_with.hpp"

namespace berth {
namespace {

using testing::distances_of;

class TwoClocks : public ::testing::Test {
 protected:
  TwoClocks()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()) {}

  Frame observe(std::size_t i) {
    Observer observer(camera_.mounted);
    Frame frame;
    observer.observe(camera_.read_depth(i), camera_.at_exposure[i], frame);
    return frame;
  }

  OpenScene scene_;
  const OpenCamera& camera_;
};

TEST_F(TwoClocks, TheJointsOfTheExposureGiveTheAnswerOfTheExposure) {
  const Frame frame = observe(3);
  testing::FrameQuery query(scene_.robot);
  const auto at_exposure = distances_of(query.ask(frame));
  EXPECT_EQ(distances_of(query.ask(frame, camera_.at_exposure[3])), at_exposure);
}

TEST_F(TwoClocks, OtherJointsGiveTheRobotOfThatPoseAgainstWhatTheFrameSaw) {
  const Frame frame = observe(3);
  testing::FrameQuery query(scene_.robot);
  JointState next = camera_.at_exposure[20];
  const Result result = query.ask(frame, next);
  EXPECT_EQ(result.stamp_s, camera_.at_exposure[3].stamp_s);
  EXPECT_EQ(result.joints_stamp_s, next.stamp_s);
  EXPECT_NE(distances_of(result), distances_of(query.ask(frame)));
}

TEST_F(TwoClocks, FramesAndQueriesCarryNothingOver) {
  Observer observer(camera_.mounted);
  testing::FrameQuery query(scene_.robot);
  Frame frame;
  const auto run = [&](std::size_t i) {
    observer.observe(camera_.read_depth(i), camera_.at_exposure[i], frame);
    return distances_of(query.ask(frame));
  };
  const auto first = run(5);
  run(25);
  EXPECT_EQ(run(5), first);
}

TEST_F(TwoClocks, TwoThreadsAskOneFrame) {
  const Frame frame = observe(7);
  std::vector<float> answers[2];
  const auto ask = [&](std::vector<float>& out) {
    testing::FrameQuery query(scene_.robot);
    for (int i = 0; i < 20; ++i) out = distances_of(query.ask(frame, camera_.at_exposure[8]));
  };
  std::thread other(ask, std::ref(answers[0]));
  ask(answers[1]);
  other.join();
  EXPECT_EQ(answers[0], answers[1]);
  EXPECT_FALSE(answers[0].empty());
}

TEST_F(TwoClocks, WrongSizesAndJointsAreRefused) {
  Observer observer(camera_.mounted);
  testing::FrameQuery query(scene_.robot);
  Frame frame = observe(0);
  EXPECT_THROW(observer.observe(DepthImage(10, 10, 1.0F), camera_.at_exposure[0], frame),
               std::invalid_argument);
  EXPECT_THROW(query.ask(frame, JointState{0, {1, 2}}), std::invalid_argument);
  JointState bad = camera_.at_exposure[0];
  bad.position[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(query.ask(frame, bad), std::invalid_argument);
}

TEST_F(TwoClocks, ABackgroundIsLearnedOnlyWhereItIsAskedForAndFromImagesOfTheCamerasSize) {
  const Frame frame = observe(0);
  const DepthImage depth_m = camera_.read_depth(0);
  EXPECT_THROW(Observer(camera_.mounted).learn_background(depth_m, frame), std::invalid_argument);

  CameraSettings settings;
  settings.sensor.background_frames = 1;
  Observer observer(testing::mounted_with(*camera_.mounted, settings));
  EXPECT_THROW(observer.learn_background(DepthImage(10, 10, 1.0F), frame), std::invalid_argument);
  Frame learned;
  observer.observe(depth_m, camera_.at_exposure[0], learned);
  EXPECT_EQ(learned.obstacles.count_of(PixelFate::background), 0);
  observer.learn_background(depth_m, learned);
  observer.observe(camera_.read_depth(20), camera_.at_exposure[20], learned);
  EXPECT_GT(learned.obstacles.count_of(PixelFate::background), 0);
}

}  // namespace
}  // namespace berth
