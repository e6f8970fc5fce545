// Method mesh from depth images to answers: several cameras, their clocks, what is not seen,
// look-ahead, and what is attached to a link.
#include <gtest/gtest.h>

#include <cmath>

#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/trajectory.hpp"
#include "berth/robot/primitives.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/view_with.hpp"

namespace berth {
namespace {

class WholeRobot : public ::testing::Test {
 protected:
  WholeRobot()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()),
        view_(testing::view_with(*camera_.view, EvaluationSettings{}, {})) {}

  void observe(std::size_t i, Frame& frame) const {
    Observer(view_).observe(camera_.read_depth(i), camera_.at_exposure[i], frame);
  }
  static std::unique_ptr<FrameSet> set_of(const std::vector<const Frame*>& frames,
                                          std::optional<double> now_s = {}) {
    auto set = std::make_unique<FrameSet>();
    set->assign(frames, {}, now_s);
    return set;
  }
  static std::vector<float> distances_of(const Answer& answer) {
    std::vector<float> distances;
    for (const LinkDistance& link : answer.distances.links) distances.push_back(link.distance_m);
    return distances;
  }

  OpenScene scene_;
  const OpenCamera& camera_;
  std::shared_ptr<const View> view_;
};

TEST_F(WholeRobot, AnswersHaveBothDistancesInTheirOrderWithTheirPoints) {
  Frame frame;
  observe(17, frame);
  Asker asker(view_->robot());
  const Answer& answer = asker.ask(frame);
  ASSERT_EQ(answer.cameras.size(), 1U);
  EXPECT_EQ(answer.cameras[0].status, CameraStatus::ok);
  const Pose X_CB = frame.X_BC.inverse();
  for (const LinkDistance& link : answer.distances.links) {
    ASSERT_EQ(link.status, LinkStatus::ok);
    EXPECT_LE(link.lower_bound_m, link.distance_m);
    EXPECT_LE(link.distance_m - link.lower_bound_m, 0.00101F);
    EXPECT_NEAR((link.obstacle_point_B_m - link.robot_point_B_m).norm(), link.distance_m, 2e-6);
    EXPECT_TRUE(link.robot_point_C_m.isApprox(
        (X_CB * link.robot_point_B_m.cast<double>()).cast<float>(), 1e-5F));
    if (link.reading.is_known()) {
      EXPECT_GE(link.reading.distance_m, link.distance_m);
      EXPECT_EQ(link.reading.kind, ObstacleKind::reading);
    }
    EXPECT_GT(link.mean_count, 0);
    EXPECT_LE(link.mean_direction_B.norm(), 1.0001F);
  }
}

TEST_F(WholeRobot, AskingAFrameASetAndTheJointsOfTheExposureIsTheSame) {
  Frame frame;
  observe(17, frame);
  Asker asker(view_->robot());
  const auto anew = [&](const auto&... question) {
    asker.forget();
    return distances_of(asker.ask(question...));
  };
  const auto alone = anew(frame);
  const auto set = set_of({&frame});
  EXPECT_EQ(anew(*set), alone);
  EXPECT_EQ(anew(*set, camera_.at_exposure[17]), alone);
  EXPECT_EQ(anew(frame, camera_.at_exposure[17]), alone);
  EXPECT_NE(anew(*set, camera_.at_exposure[3]), alone);
}

TEST_F(WholeRobot, ACameraThatIsMissingLateUntimelyOrBlindIsNamed) {
  Frame fresh, old, untimely, blind;
  observe(17, fresh);
  observe(3, old);
  FrameTime skewed;
  skewed.status = TimeStatus::skewed;
  Observer(view_).observe(camera_.read_depth(17), camera_.at_exposure[17], untimely, skewed);
  Observer(view_).observe(DepthImage(640, 480, kNoDepth), camera_.at_exposure[17], blind);
  const auto set = set_of({&fresh, nullptr, &old, &untimely, &blind});
  const std::vector<CameraStatus> expected = {CameraStatus::ok, CameraStatus::no_frame,
                                              CameraStatus::too_old, CameraStatus::untimely,
                                              CameraStatus::blind};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(set->cameras()[k].status, expected[k]) << name_of(set->cameras()[k].status);
  }
  EXPECT_EQ(set->cameras()[3].time, TimeStatus::skewed);
  EXPECT_NEAR(set->cameras()[2].age_s, 1.4, 1e-9);
  Asker asker(view_->robot());
  const auto with_all = distances_of(asker.ask(*set));
  const auto alone = distances_of(asker.ask(fresh));
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_NEAR(with_all[i], alone[i], 0.001) << "those that are left out change nothing";
  }
}

TEST_F(WholeRobot, WithoutAnyFrameInTimeTheAnswerIsWithheld) {
  Frame frame;
  observe(17, frame);
  Asker asker(view_->robot());
  const std::unique_ptr<FrameSet> sets[] = {set_of({}), set_of({nullptr}),
                                            set_of({&frame}, frame.stamp_s + 1)};
  const TimeStatus statuses[] = {TimeStatus::no_frame, TimeStatus::no_frame,
                                 TimeStatus::stale_frame};
  for (int i = 0; i < 3; ++i) {
    const TimeStatus status = statuses[i];
    const Answer& answer = asker.ask(*sets[i]);
    EXPECT_EQ(answer.time.status, status) << name_of(answer.time.status);
    for (const LinkDistance& link : answer.distances.links) {
      EXPECT_EQ(link.status, LinkStatus::untimely);
      EXPECT_TRUE(std::isnan(link.distance_m));
    }
  }
}

TEST_F(WholeRobot, AWithheldAnswerHasTheCamerasOfItsOwnQuestion) {
  Frame left, right, untimely;
  observe(17, left);
  observe(17, right);
  FrameTime skewed;
  skewed.status = TimeStatus::skewed;
  Observer(view_).observe(camera_.read_depth(17), camera_.at_exposure[17], untimely, skewed);
  const auto both = set_of({&left, &right});
  Asker asker(view_->robot());
  EXPECT_EQ(asker.ask(*both).cameras.size(), 2U);
  ASSERT_EQ(asker.ask(untimely).cameras.size(), 1U);
  EXPECT_EQ(asker.ask(untimely).cameras[0].status, CameraStatus::untimely);
  EXPECT_EQ(asker.ask(untimely).cameras[0].time, TimeStatus::skewed);

  const double late_s = left.stamp_s + 1;
  EXPECT_EQ(asker.ask(*both).cameras.size(), 2U);
  ASSERT_EQ(asker.ask(left, camera_.at_exposure[17], late_s).cameras.size(), 1U);
  EXPECT_EQ(asker.ask(left, late_s).cameras[0].status, CameraStatus::too_old);
  EXPECT_NEAR(asker.ask(left, late_s).cameras[0].age_s, 1, 1e-9);

  const JointBuffer no_joints(view_->robot()->model(), 2);
  EXPECT_EQ(asker.ask(*both, no_joints, left.stamp_s).cameras.size(), 2U);
  ASSERT_EQ(asker.ask(left, no_joints, left.stamp_s).cameras.size(), 1U);
}

TEST_F(WholeRobot, AFrameThatNobodyObservedIsNoFrame) {
  for (const auto& robot : {view_->robot(), camera_.view->robot()}) {
    Asker asker(robot);
    EXPECT_EQ(asker.ask(Frame()).time.status, TimeStatus::no_frame);
    const Answer& answer = asker.ask(Frame(), camera_.at_exposure[17], 1.7);
    EXPECT_EQ(answer.time.status, TimeStatus::no_frame);
    EXPECT_TRUE(std::isnan(answer.time.frame_age_s));
    for (const LinkDistance& link : answer.distances.links) {
      EXPECT_EQ(link.status, LinkStatus::untimely);
    }
    for (const CameraState& camera : answer.cameras) {
      EXPECT_EQ(camera.status, CameraStatus::no_frame);
    }
  }
}

TEST_F(WholeRobot, NothingSeenIsNotFree) {
  Frame frame;
  Observer(view_).observe(DepthImage(640, 480, kNoDepth), camera_.at_exposure[17], frame);
  Asker asker(view_->robot());
  const Answer& answer = asker.ask(frame);
  EXPECT_EQ(answer.cameras[0].status, CameraStatus::blind);
  for (const LinkDistance& link : answer.distances.links) {
    EXPECT_EQ(link.status, LinkStatus::not_seen);
    EXPECT_FALSE(link.has_distance());
  }
}

TEST_F(WholeRobot, ALinkThatNoCameraSeesKeepsItsDistanceBesideTheStatus) {
  DepthImage depth_m = camera_.read_depth(17);
  // A plate right before the camera, but for the image's left edge.
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) depth_m(u, v) = 0.3F;
  }
  Frame frame;
  Observer(view_).observe(depth_m, camera_.at_exposure[17], frame);
  Asker asker(view_->robot());
  for (const LinkDistance& link : asker.ask(frame).distances.links) {
    EXPECT_EQ(link.status, LinkStatus::not_seen);
    EXPECT_LE(link.distance_m, MeshQuestion{}.tolerance_m) << "all of it is hidden";
    EXPECT_EQ(link.lower_bound_m, 0);
    EXPECT_EQ(link.obstacle_kind, ObstacleKind::hidden);
  }
}

TEST_F(WholeRobot, ATrajectoryIsItsPosesAndSaysWhichComesNearerFirst) {
  Frame frame;
  observe(3, frame);
  const auto set = set_of({&frame});
  std::vector<JointState> path(camera_.at_exposure.begin(), camera_.at_exposure.begin() + 12);
  TrajectoryAsker looking_ahead(view_->robot());
  const TrajectoryAnswer& found = looking_ahead.ask(*set, path, 0);
  ASSERT_EQ(found.poses.size(), path.size());
  EXPECT_FALSE(found.first_nearer.has_value());
  Asker asker(view_->robot());
  float least_m = 1;
  std::size_t nearest_pose = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Answer& answer = asker.ask(*set, path[i]);
    for (std::size_t k = 0; k < answer.distances.links.size(); ++k) {
      const SpacePair& pair = found.poses[i][k].nearest;
      EXPECT_NEAR(pair.distance_m, answer.distances.links[k].distance_m, 0.0011);
      if (pair.lower_bound_m >= least_m) continue;
      least_m = pair.lower_bound_m;
      nearest_pose = i;
    }
  }
  EXPECT_EQ(looking_ahead.ask(*set, path, least_m + 1e-6).first_nearer, nearest_pose);
  EXPECT_THROW(looking_ahead.ask(*set, path, std::nan("")), std::invalid_argument);
}

TEST_F(WholeRobot, WhatIsAttachedIsPartOfItsLinkOrALinkOfItsOwn) {
  const RobotModel& model = view_->robot()->model();
  const std::string hand = model.evaluated_link_names().back();
  Attachment tool{"tool", hand, make_box({0.02, 0.02, 0.4}), Pose::Identity(), true};
  const auto with_tool = attach(*view_->robot(), tool);
  EXPECT_EQ(with_tool->model().link_count(), model.link_count() + 1);
  EXPECT_EQ(with_tool->model().evaluated_link_names().back(), "tool");
  tool.is_link = false;
  const auto longer_hand = attach(*view_->robot(), tool);
  EXPECT_EQ(longer_hand->model().link_count(), model.link_count());

  const auto distance_of_last = [&](const std::shared_ptr<const Robot>& robot) {
    const auto view = with_robot(*view_, robot);
    Frame frame;
    Observer(view).observe(camera_.read_depth(3), camera_.at_exposure[3], frame);
    return Asker(robot).ask(frame).distances.links.back().distance_m;
  };
  const float own = distance_of_last(with_tool), part = distance_of_last(longer_hand);
  const float bare = distance_of_last(view_->robot());
  EXPECT_LT(part, bare);
  EXPECT_NEAR(std::min(own, bare), part, 0.03);
  EXPECT_EQ(distance_of_last(detach(*longer_hand, "tool")), bare);

  EXPECT_THROW(attach(*with_tool, tool), std::invalid_argument);
  EXPECT_THROW(detach(*view_->robot(), "tool"), std::invalid_argument);
  tool.link = "nowhere";
  EXPECT_NE(error_message<std::invalid_argument>([&] { attach(*view_->robot(), tool); })
                .find("link \"nowhere\" is no evaluated link"),
            std::string::npos);
}

TEST_F(WholeRobot, MethodsThatCompareImagesTakeOneFrame) {
  Frame frame;
  observe(3, frame);
  const auto set = set_of({&frame});
  Asker asker(camera_.view->robot());
  EXPECT_EQ(error_message<std::invalid_argument>([&] { asker.ask(*set); }),
            "method exact looks at one frame; expected mesh for several");
  EXPECT_THROW(TrajectoryAsker(camera_.view->robot()), std::invalid_argument);
}

}  // namespace
}  // namespace berth
