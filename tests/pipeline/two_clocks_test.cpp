// Frames at the camera's clock, questions at the controller's.
#include <gtest/gtest.h>

#include <thread>

#include "berth/scene/open_scene.hpp"
#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/observer.hpp"
#include "tests/support/view_with.hpp"

namespace berth {
namespace {

std::vector<float> distances_of(const Answer& answer) {
  std::vector<float> distances;
  for (const LinkDistance& link : answer.distances.links) distances.push_back(link.distance_m);
  return distances;
}

class TwoClocks : public ::testing::Test {
 protected:
  TwoClocks()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()) {}

  Frame observe(std::size_t i) {
    Observer observer(camera_.view);
    Frame frame;
    observer.observe(camera_.read_depth(i), camera_.at_exposure[i], frame);
    return frame;
  }

  OpenScene scene_;
  const OpenCamera& camera_;
};

TEST_F(TwoClocks, TheJointsOfTheExposureGiveTheAnswerOfTheExposure) {
  const Frame frame = observe(3);
  Asker asker(camera_.view->robot());
  const auto at_exposure = distances_of(asker.ask(frame));
  EXPECT_EQ(distances_of(asker.ask(frame, camera_.at_exposure[3])), at_exposure);
}

TEST_F(TwoClocks, OtherJointsGiveTheRobotOfThatPoseAgainstWhatTheFrameSaw) {
  const Frame frame = observe(3);
  Asker asker(camera_.view->robot());
  JointState next = camera_.at_exposure[20];
  const Answer answer = asker.ask(frame, next);
  EXPECT_EQ(answer.frame_stamp_s, camera_.at_exposure[3].stamp_s);
  EXPECT_EQ(answer.joints_stamp_s, next.stamp_s);
  EXPECT_NE(distances_of(answer), distances_of(asker.ask(frame)));

  RobotPose pose;
  forward_kinematics(camera_.view->robot()->model(), next.position, pose);
  RobotImage robot;
  RobotRenderer(camera_.view->robot()->meshes(), camera_.view->camera()).render(pose, frame.X_BC, robot);
  EvaluateWorkspace workspace;
  LinkDistances expected;
  evaluate(Method::exact,
           {camera_.view->camera(), robot, camera_.view->robot()->model().link_count(), frame.searchable, {}},
           workspace, expected);
  for (std::size_t i = 0; i < expected.links.size(); ++i) {
    EXPECT_EQ(answer.distances.links[i].distance_m, expected.links[i].distance_m);
  }
}

TEST_F(TwoClocks, FramesAndAskersCarryNothingOver) {
  Observer observer(camera_.view);
  Asker asker(camera_.view->robot());
  Frame frame;
  const auto run = [&](std::size_t i) {
    observer.observe(camera_.read_depth(i), camera_.at_exposure[i], frame);
    return distances_of(asker.ask(frame));
  };
  const auto first = run(5);
  run(25);
  EXPECT_EQ(run(5), first);
}

TEST_F(TwoClocks, TwoThreadsAskOneFrame) {
  const Frame frame = observe(7);
  std::vector<float> answers[2];
  const auto ask = [&](std::vector<float>& out) {
    Asker asker(camera_.view->robot());
    for (int i = 0; i < 20; ++i) out = distances_of(asker.ask(frame, camera_.at_exposure[8]));
  };
  std::thread other(ask, std::ref(answers[0]));
  ask(answers[1]);
  other.join();
  EXPECT_EQ(answers[0], answers[1]);
  EXPECT_FALSE(answers[0].empty());
}

TEST_F(TwoClocks, WrongSizesAndJointsAreRefused) {
  Observer observer(camera_.view);
  Asker asker(camera_.view->robot());
  Frame frame = observe(0);
  EXPECT_THROW(observer.observe(DepthImage(10, 10, 1.0F), camera_.at_exposure[0], frame),
               std::invalid_argument);
  EXPECT_THROW(asker.ask(frame, JointState{0, {1, 2}}), std::invalid_argument);
  JointState bad = camera_.at_exposure[0];
  bad.position[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(asker.ask(frame, bad), std::invalid_argument);
}

TEST_F(TwoClocks, ABackgroundIsLearnedOnlyWhereItIsAskedForAndFromImagesOfTheCamerasSize) {
  const Frame frame = observe(0);
  const DepthImage depth_m = camera_.read_depth(0);
  EXPECT_THROW(Observer(camera_.view).learn_background(depth_m, frame), std::invalid_argument);

  ViewSettings settings;
  settings.sensor.background_frames = 1;
  Observer observer(testing::view_with(*camera_.view, settings));
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
