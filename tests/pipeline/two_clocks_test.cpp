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

class TwoClocks : public testing::Test {
 protected:
  TwoClocks()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml")),
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
