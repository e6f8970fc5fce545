// From depth images to results: several cameras, their clocks, what is not seen, look-ahead, and
// what is attached to a link.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

#include "berth/distance/known_model.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/robot/primitives.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/pipeline/frame_query.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/mounted_with.hpp"

namespace berth {
namespace {

class WholeRobot : public ::testing::Test {
 protected:
  WholeRobot()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()),
        mounted_(testing::mounted_with(*camera_.mounted, EvaluationSettings{}, {})) {}

  void observe(std::size_t i, Frame& frame) const {
    Observer(mounted_).observe(camera_.read_depth(i), camera_.at_exposure[i], frame);
  }

  OpenScene scene_;
  const OpenCamera& camera_;
  std::shared_ptr<const MountedCamera> mounted_;
};

TEST_F(WholeRobot, AnswersHaveBothDistancesInTheirOrderWithTheirPoints) {
  Frame frame;
  observe(17, frame);
  Query query(mounted_->robot());
  const Result& result = query.ask({frame});
  ASSERT_EQ(result.cameras.size(), 1U);
  EXPECT_EQ(result.cameras[0].status, CameraStatus::ok);
  const Pose X_CB = frame.X_BC.inverse();
  for (const LinkResult& link : result.links) {
    ASSERT_EQ(link.status, LinkStatus::ok);
    EXPECT_LE(link.lower_bound_m, link.distance_m);
    EXPECT_LE(link.distance_m - link.lower_bound_m, 0.00101F);
    EXPECT_NEAR((link.obstacle_point_B_m - link.robot_point_B_m).norm(), link.distance_m, 2e-6);
    EXPECT_TRUE(link.robot_point_C_m.isApprox(
        (X_CB * link.robot_point_B_m.cast<double>()).cast<float>(), 1e-5F));
    if (link.occupied.is_known()) {
      EXPECT_GE(link.occupied.distance_m, link.distance_m);
      EXPECT_EQ(link.occupied.obstacle_is, ObstacleKind::occupied);
    }
    EXPECT_GT(link.mean_count, 0);
    EXPECT_LE(link.mean_direction_B.norm(), 1.0001F);
  }
}

TEST_F(WholeRobot, AskingAFrameAListOfOneAndTheJointsOfTheExposureIsTheSame) {
  Frame frame;
  observe(17, frame);
  Query query(mounted_->robot());
  const auto anew = [&](const Request& request) {
    query.forget();
    return testing::distances_of(query.ask(request));
  };
  const auto alone = anew({frame});
  const std::vector<const Frame*> list = {&frame};
  EXPECT_EQ(anew({list}), alone);
  EXPECT_EQ(anew({list, camera_.at_exposure[17]}), alone);
  EXPECT_EQ(anew({frame, camera_.at_exposure[17]}), alone);
  EXPECT_NE(anew({list, camera_.at_exposure[3]}), alone);
}

TEST_F(WholeRobot, ACameraThatIsMissingLateStaleOrBlindIsNamed) {
  Frame fresh, old, stale, blind;
  observe(17, fresh);
  observe(3, old);
  FrameTime skewed;
  skewed.status = TimeStatus::skewed;
  Observer(mounted_).observe(camera_.read_depth(17), camera_.at_exposure[17], stale, skewed);
  Observer(mounted_).observe(DepthImage(640, 480, kNoDepth), camera_.at_exposure[17], blind);
  const std::vector<const Frame*> frames = {&fresh, nullptr, &old, &stale, &blind};
  Query query(mounted_->robot());
  const Result result = query.ask({frames});
  const std::vector<CameraStatus> expected = {CameraStatus::ok, CameraStatus::no_frame,
                                              CameraStatus::too_old, CameraStatus::stale,
                                              CameraStatus::blind};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(result.cameras[k].status, expected[k]) << name_of(result.cameras[k].status);
  }
  EXPECT_EQ(result.cameras[3].time, TimeStatus::skewed);
  EXPECT_NEAR(result.cameras[2].age_s, 1.4, 1e-9);
  EXPECT_EQ(result.status, ResultStatus::degraded);
  const auto with_all = testing::distances_of(result);
  const auto alone = testing::distances_of(query.ask({fresh}));
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_NEAR(with_all[i], alone[i], 0.001) << "those that are left out change nothing";
  }
}

TEST_F(WholeRobot, WithoutAnyFrameInTimeTheAnswerIsWithheld) {
  Frame frame;
  observe(17, frame);
  Query query(mounted_->robot());
  const std::vector<const Frame*> none = {nullptr};
  const Request requests[] = {{none}, {frame, {}, frame.stamp_s + 1}};
  const TimeStatus statuses[] = {TimeStatus::no_frame, TimeStatus::stale_frame};
  for (int i = 0; i < 2; ++i) {
    const TimeStatus status = statuses[i];
    const Result& result = query.ask(requests[i]);
    EXPECT_EQ(result.time.status, status) << name_of(result.time.status);
    EXPECT_EQ(result.status, ResultStatus::stale);
    for (const LinkResult& link : result.links) {
      EXPECT_EQ(link.status, LinkStatus::stale);
      EXPECT_TRUE(std::isnan(link.distance_m));
    }
  }
}

TEST_F(WholeRobot, AWithheldResultHasTheCamerasOfItsOwnRequest) {
  Frame left, right, stale;
  observe(17, left);
  observe(17, right);
  FrameTime skewed;
  skewed.status = TimeStatus::skewed;
  Observer(mounted_).observe(camera_.read_depth(17), camera_.at_exposure[17], stale, skewed);
  const std::vector<const Frame*> both = {&left, &right};
  Query query(mounted_->robot());
  EXPECT_EQ(query.ask({both}).cameras.size(), 2U);
  ASSERT_EQ(query.ask({stale}).cameras.size(), 1U);
  EXPECT_EQ(query.ask({stale}).cameras[0].status, CameraStatus::stale);
  EXPECT_EQ(query.ask({stale}).cameras[0].time, TimeStatus::skewed);

  const double late_s = left.stamp_s + 1;
  EXPECT_EQ(query.ask({both}).cameras.size(), 2U);
  ASSERT_EQ(query.ask({left, camera_.at_exposure[17], late_s}).cameras.size(), 1U);
  EXPECT_EQ(query.ask({left, {}, late_s}).cameras[0].status, CameraStatus::too_old);
  EXPECT_NEAR(query.ask({left, {}, late_s}).cameras[0].age_s, 1, 1e-9);

  const JointBuffer no_joints(mounted_->robot()->model(), 2);
  EXPECT_EQ(query.ask({both, no_joints, left.stamp_s}).cameras.size(), 2U);
  ASSERT_EQ(query.ask({left, no_joints, left.stamp_s}).cameras.size(), 1U);
}

TEST_F(WholeRobot, AFrameThatNobodyObservedIsNoFrame) {
  testing::FrameQuery query(mounted_->robot());
  EXPECT_EQ(query.ask(Frame()).time.status, TimeStatus::no_frame);
  const Result& result = query.ask(Frame(), camera_.at_exposure[17], 1.7);
  EXPECT_EQ(result.time.status, TimeStatus::no_frame);
  EXPECT_TRUE(std::isnan(result.time.frame_age_s));
  for (const LinkResult& link : result.links) {
    EXPECT_EQ(link.status, LinkStatus::stale);
  }
  for (const CameraResult& camera : result.cameras) {
    EXPECT_EQ(camera.status, CameraStatus::no_frame);
    EXPECT_FALSE(camera.has_frame);
  }
}

TEST_F(WholeRobot, NothingSeenIsNotFree) {
  Frame frame;
  Observer(mounted_).observe(DepthImage(640, 480, kNoDepth), camera_.at_exposure[17], frame);
  Query query(mounted_->robot());
  const Result& result = query.ask({frame});
  EXPECT_EQ(result.cameras[0].status, CameraStatus::blind);
  EXPECT_EQ(result.status, ResultStatus::degraded);
  for (const LinkResult& link : result.links) {
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
  Observer(mounted_).observe(depth_m, camera_.at_exposure[17], frame);
  Query query(mounted_->robot());
  for (const LinkResult& link : query.ask({frame}).links) {
    EXPECT_EQ(link.status, LinkStatus::not_seen);
    EXPECT_LE(link.distance_m, MeshRequest{}.tolerance_m) << "all of it is hidden";
    EXPECT_EQ(link.lower_bound_m, 0);
    EXPECT_EQ(link.obstacle_is, ObstacleKind::unknown);
  }
}

/// The camera stands 2 m away, and nothing is near: most of a ball of 3 m is in no image.
TEST_F(WholeRobot, ALinkNearMuchThatIsInNoImageIsNotCalledFree) {
  const auto ask = [&](std::optional<Unobserved> unobserved) {
    EvaluationSettings evaluation;
    evaluation.distance.range_m = 3;
    CameraSettings settings;
    settings.space.unobserved = unobserved;
    const auto mounted = testing::mounted_with(*camera_.mounted, evaluation, settings);
    Frame frame;
    Observer observer(mounted);
    observer.observe(camera_.read_depth(17), camera_.at_exposure[17], frame);
    DepthImage depth_m = frame.robot.depth_m;
    for (float& one_m : depth_m.pixels()) one_m = std::isnan(one_m) ? 9 : one_m;
    observer.observe(depth_m, camera_.at_exposure[17], frame);
    return Query(mounted->robot()).ask({frame}).links.back();
  };
  EXPECT_EQ(ask(std::nullopt).status, LinkStatus::not_observed);
  EXPECT_EQ(ask(Unobserved::ignore).status, LinkStatus::none_in_range);
  const LinkResult link = ask(Unobserved::unknown);
  EXPECT_EQ(link.status, LinkStatus::ok);
  EXPECT_EQ(link.obstacle_is, ObstacleKind::unobserved);
  EXPECT_EQ(link.obstacle_pixel, (Pixel{-1, -1}));
  EXPECT_LT(link.distance_m, 1.5F);
  EXPECT_LE(link.distance_m - link.lower_bound_m, 0.00101F);
  EXPECT_FALSE(
      project_into_image(camera_.mounted->camera(), link.obstacle_point_C_m.cast<double>()));
}

TEST_F(WholeRobot, LookAheadIsItsPosesAndSaysWhichComesNearerFirst) {
  Frame frame;
  observe(3, frame);
  std::vector<JointState> path(camera_.at_exposure.begin(), camera_.at_exposure.begin() + 12);
  Query looking_ahead(mounted_->robot());
  const LookAhead found = looking_ahead.ask({.frames = frame, .ahead = path}).ahead;
  ASSERT_EQ(found.poses.size(), path.size());
  EXPECT_FALSE(found.first_nearer.has_value());
  Query query(mounted_->robot());
  float least_m = 1;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Result& result = query.ask({frame, path[i]});
    EXPECT_TRUE(result.ahead.poses.empty());
    for (std::size_t k = 0; k < result.links.size(); ++k) {
      const SpacePair& pair = found.poses[i][k].nearest;
      EXPECT_NEAR(pair.distance_m, result.links[k].distance_m, 0.0011);
      least_m = std::min(least_m, pair.lower_bound_m);
    }
  }
  const auto is_nearer = [](const std::vector<WholeLinkDistance>& links, double limit_m) {
    return std::ranges::any_of(
        links, [&](const WholeLinkDistance& link) { return link.nearest.lower_bound_m < limit_m; });
  };
  const auto first_nearer = [&](double limit_m) {
    return looking_ahead.ask({.frames = frame, .ahead = path, .nearer_than_m = limit_m})
        .ahead.first_nearer;
  };
  // Bounds may differ by the tolerance from request to request.
  EXPECT_FALSE(first_nearer(least_m - 0.0011).has_value());
  const LookAhead nearer =
      looking_ahead.ask({.frames = frame, .ahead = path, .nearer_than_m = least_m + 0.0011}).ahead;
  ASSERT_TRUE(nearer.first_nearer.has_value());
  for (std::size_t i = 0; i <= *nearer.first_nearer; ++i) {
    EXPECT_EQ(is_nearer(nearer.poses[i], least_m + 0.0011), i == *nearer.first_nearer) << i;
  }
  EXPECT_THROW(first_nearer(std::nan("")), std::invalid_argument);
  const Result& late =
      looking_ahead.ask({.frames = frame, .now_s = frame.stamp_s + 1, .ahead = path});
  EXPECT_TRUE(late.ahead.poses.empty()) << "a stale result tells nothing of what is ahead";
  EXPECT_FALSE(late.ahead.first_nearer.has_value());
}

TEST_F(WholeRobot, WhatIsAttachedIsPartOfItsLinkOrALinkOfItsOwn) {
  const RobotModel& model = mounted_->robot()->model();
  const std::string hand = model.evaluated_link_names().back();
  Attachment tool{"tool", hand, make_box({0.02, 0.02, 0.4}), Pose::Identity(), true};
  const auto with_tool = attach(*mounted_->robot(), tool);
  EXPECT_EQ(with_tool->model().link_count(), model.link_count() + 1);
  EXPECT_EQ(with_tool->model().evaluated_link_names().back(), "tool");
  tool.is_link = false;
  const auto longer_hand = attach(*mounted_->robot(), tool);
  EXPECT_EQ(longer_hand->model().link_count(), model.link_count());

  const auto distance_of_last = [&](const std::shared_ptr<const Robot>& robot) {
    const auto mounted = with_robot(*mounted_, robot);
    Frame frame;
    Observer(mounted).observe(camera_.read_depth(3), camera_.at_exposure[3], frame);
    return Query(robot).ask({frame}).links.back().distance_m;
  };
  const float own = distance_of_last(with_tool), part = distance_of_last(longer_hand);
  const float bare = distance_of_last(mounted_->robot());
  EXPECT_LT(part, bare);
  EXPECT_NEAR(std::min(own, bare), part, 0.03);
  EXPECT_EQ(distance_of_last(detach(*longer_hand, "tool")), bare);

  EXPECT_THROW(attach(*with_tool, tool), std::invalid_argument);
  EXPECT_THROW(detach(*mounted_->robot(), "tool"), std::invalid_argument);
  tool.link = "nowhere";
  EXPECT_NE(error_message<std::invalid_argument>([&] {
              attach(*mounted_->robot(), tool);
            }).find("link \"nowhere\" is no evaluated link"),
            std::string::npos);
}

// It would be the robot in every image, and nothing an obstacle.
using Touching = std::set<std::pair<std::size_t, std::size_t>>;

Touching touching_links(const Robot& robot) {
  Touching links;
  for (const LeftOutPair& pair : robot.known().left_out) {
    if (pair.reason == LeftOutReason::always_touch) links.emplace(pair.link, pair.other);
  }
  return links;
}

/// Boxes on a chain: a and c always touch, d is 1 m away from c.
RobotModel four_boxes() {
  std::string text = "<robot name=\"boxes\">", before;
  for (const auto& [name, x_m] : {std::pair{"a", 0.0}, {"b", 0.05}, {"c", 0.05}, {"d", 1.0}}) {
    text += fmt::format(
        "<link name=\"{}\"><visual><geometry><box size=\".3 .3 .3\"/></geometry></visual></link>",
        name);
    if (!before.empty()) {
      text += fmt::format(
          "<joint name=\"to_{0}\" type=\"continuous\"><parent link=\"{1}\"/><child link=\"{0}\"/>"
          "<origin xyz=\"{2} 0 0\"/><axis xyz=\"0 0 1\"/></joint>",
          name, before, x_m);
    }
    before = name;
  }
  return load_robot({.urdf = "boxes.urdf", .urdf_text = text + "</robot>"});
}

TEST(AttachedRobot, LinksThatAlwaysTouchAreTheSameWhateverWasAttachedBefore) {
  const Robot bare(four_boxes());
  const Attachment ball{"ball", "d", make_sphere(1.2)};
  const Robot fresh(bare.bare(), bare.settings(), {ball});
  ASSERT_EQ(touching_links(bare), (Touching{{2, 0}}));
  ASSERT_EQ(touching_links(fresh), (Touching{{1, 3}, {2, 0}, {3, 0}}));
  // The ball's first, and its links are not the bare robot's.
  const auto holding = bare.with({ball});
  EXPECT_EQ(touching_links(*holding), touching_links(fresh));
  EXPECT_EQ(touching_links(*holding->with({})), touching_links(bare));
  EXPECT_EQ(touching_links(*attach(bare, ball)), touching_links(fresh));
}

TEST_F(WholeRobot, AThingInMillimetresIsRefused) {
  const std::string hand = mounted_->robot()->model().evaluated_link_names().back();
  EXPECT_EQ(
      error_message<std::invalid_argument>([&] {
        attach(*mounted_->robot(), {"gripper", hand, make_box({60, 40, 120})});
      }),
      "attached \"gripper\": reaches 70 m from its origin; expected at most 20 m. If its lengths "
      "are in millimetres, write them in metres");
  EXPECT_NO_THROW(attach(*mounted_->robot(), {"beam", hand, make_box({0.1, 0.1, 12})}));
  TriangleMesh spoilt = make_box({0.1, 0.1, 0.1});
  spoilt.vertices_m.front().x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(attach(*mounted_->robot(), {"spoilt", hand, spoilt}), std::invalid_argument);
}

TEST_F(WholeRobot, WhatIsSoftIsRejected) {
  Frame bare_frame;
  observe(17, bare_frame);
  const LinkResult bare = Query(mounted_->robot()).ask({bare_frame}).links.back();
  ASSERT_TRUE(bare.occupied.is_known());
  // Where the nearest thing is, something soft may hang.
  const RobotModel& model = mounted_->robot()->model();
  const std::string hand = model.evaluated_link_names().back();
  Attachment hose{"hose", hand, make_sphere(0.1)};
  hose.X_LA.translation() = bare_frame.pose.X_BL[*model.find_link(hand)].inverse() *
                            bare.occupied.obstacle_point_B_m.cast<double>();
  hose.is_soft = true;
  const auto robot = attach(*mounted_->robot(), hose);
  EXPECT_EQ(robot->model().links.size(), model.links.size());
  const auto mounted = with_robot(*mounted_, robot);
  Frame frame;
  Observer(mounted).observe(camera_.read_depth(17), camera_.at_exposure[17], frame);
  EXPECT_GT(frame.obstacles.count_of(PixelFate::soft), 10);
  const LinkResult soft = Query(robot).ask({frame}).links.back();
  EXPECT_GT(soft.occupied.distance_m, bare.occupied.distance_m + 0.01F);
  EXPECT_NEAR(soft.visibility.rejected_distance_m, bare.occupied.distance_m, 0.01);
  EXPECT_TRUE(detach(*robot, "hose")->model().soft_bodies.empty());

  hose.mesh_A.triangles.pop_back();
  EXPECT_EQ(error_message<std::invalid_argument>([&] { attach(*mounted_->robot(), hose); }),
            "attached \"hose\": the mesh is not closed; expected one that encloses a space");
}

}  // namespace
}  // namespace berth
