// What comes with a result: its status, its cameras, its nearest link, and points in every frame.
#include "berth/pipeline/query.hpp"

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

using Frames = std::vector<const Frame*>;

class Queries : public ::testing::Test {
 protected:
  Queries()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()),
        robot_(scene_.robot) {
    observe(17, left_, view_named("left"));
    observe(17, right_, view_named("right"));
  }

  /// As the bundled camera, but believed to be turned by so much.
  std::shared_ptr<const MountedCamera> view_named(const std::string& name, double turn_rad = 0,
                                                  const WatchSettings& watch = {}) const {
    CameraMount mount = camera_.mounted->mount();
    mount.name = name;
    mount.X_PC.rotate(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitY()));
    CameraSettings settings;
    settings.watch = watch;
    return std::make_shared<const MountedCamera>(robot_, mount, settings);
  }
  void observe(std::size_t i, Frame& frame, const std::shared_ptr<const MountedCamera>& mounted,
               FrameTime time = {}) const {
    Observer(mounted).observe(camera_.read_depth(i), camera_.at_exposure[i], frame, time);
  }

  OpenScene scene_;
  const OpenCamera& camera_;
  std::shared_ptr<const Robot> robot_;
  Frame left_, right_;
};

TEST_F(Queries, AResultIsDegradedWhereACameraIsNotInItAndStaleWhereNoneIs) {
  Frame old, stale, moved, implausible, blind;
  observe(3, old, view_named("old"));
  FrameTime skewed;
  skewed.status = TimeStatus::skewed;
  observe(17, stale, view_named("stale"), skewed);
  const WatchSettings each_frame{.max_seen_through = 0.03, .agreeing_frames = 1, .frames = 1};
  observe(17, moved, view_named("moved", 0.05, each_frame));
  DepthImage depth_m = camera_.read_depth(17);
  for (float& z_m : depth_m.pixels()) z_m *= 10;
  Observer(view_named("implausible")).observe(depth_m, camera_.at_exposure[17], implausible);
  Observer(view_named("blind"))
      .observe(DepthImage(640, 480, kNoDepth), camera_.at_exposure[17], blind);

  const double now_s = left_.stamp_s;
  Query query(robot_);
  EXPECT_EQ(query.ask({left_, {}, now_s}).status, ResultStatus::ok);
  EXPECT_EQ(query.ask({Frames{&left_, &right_}, {}, now_s}).status, ResultStatus::ok);
  const std::pair<const Frame*, CameraStatus> others[] = {{nullptr, CameraStatus::no_frame},
                                                          {&old, CameraStatus::too_old},
                                                          {&stale, CameraStatus::stale},
                                                          {&moved, CameraStatus::moved},
                                                          {&implausible, CameraStatus::implausible},
                                                          {&blind, CameraStatus::blind}};
  for (const auto& [frame, status] : others) {
    SCOPED_TRACE(name_of(status));
    const Result beside_left = query.ask({Frames{&left_, frame}, {}, now_s});
    EXPECT_EQ(beside_left.status, ResultStatus::degraded);
    EXPECT_EQ(beside_left.cameras[0].status, CameraStatus::ok);
    EXPECT_EQ(beside_left.cameras[1].status, status);
    EXPECT_NE(beside_left.nearest, -1);
    const Result alone = query.ask({Frames{frame}, {}, now_s});
    // What a covered camera still reads counts.
    EXPECT_EQ(alone.status,
              status == CameraStatus::blind ? ResultStatus::degraded : ResultStatus::stale);
    EXPECT_EQ(alone.nearest, -1);
    for (const LinkResult& link : alone.links) EXPECT_FALSE(link.has_distance());
    EXPECT_EQ(alone.pose.X_BL.empty(), alone.status == ResultStatus::stale);
  }
}

TEST_F(Queries, CamerasAreToldByTheirNamesAndPlaces) {
  Query query(robot_, {"one", "two", "three"});
  const Result& result = query.ask({Frames{nullptr, &right_, &left_}});
  ASSERT_EQ(result.cameras.size(), 3U);
  EXPECT_EQ(result.cameras[0].camera, "one") << "it has given no frame yet";
  EXPECT_EQ(result.cameras[1].camera, "right") << "a frame knows its own";
  EXPECT_EQ(result.cameras[2].camera, "left");
  EXPECT_FALSE(result.cameras[0].has_frame);
  EXPECT_FALSE(result.cameras[0].mounted);
  const CameraResult& left = result.cameras[2];
  EXPECT_TRUE(left.has_frame);
  EXPECT_EQ(left.mounted, left_.mounted);
  EXPECT_TRUE(left.X_BC.isApprox(left_.X_BC));
  EXPECT_EQ(left.self_filter, left_.obstacles.count);
  EXPECT_EQ(left.stamp_s, left_.stamp_s);
  for (const LinkResult& link : result.links) {
    ASSERT_TRUE(link.is_known());
    EXPECT_EQ(result.camera_of(link), result.cameras[link.camera].camera);
    EXPECT_NE(link.camera, 0);
  }
  EXPECT_EQ(result.camera_of(SpacePair()), "");
  EXPECT_EQ(query.ask({left_}).cameras[0].camera, "left") << "not the name of the one before";
}

TEST_F(Queries, LinksHaveNamesStatusesAndPointsInBothFrames) {
  testing::FrameQuery query(robot_);
  const Result& result = query.ask(left_);
  EXPECT_EQ(result.status, ResultStatus::ok);
  EXPECT_EQ(result.range_m, robot_->settings().distance.range_m);
  EXPECT_EQ(result.pose.X_BL.size(), robot_->model().links.size());
  const std::vector<std::string> names = robot_->model().evaluated_link_names();
  ASSERT_EQ(result.links.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const LinkResult& link = result.links[i];
    EXPECT_EQ(link.id, i + 1);
    EXPECT_EQ(link.link, names[i]);
    EXPECT_EQ(link.is_moved, i > 0) << "the arm's first link stands on the table";
    ASSERT_EQ(link.status, LinkStatus::ok);
    EXPECT_EQ(link.camera, 0);
    const auto in_base = [&](const Eigen::Vector3f& p_C) -> Eigen::Vector3f {
      return (left_.X_BC * p_C.cast<double>()).cast<float>();
    };
    EXPECT_TRUE(link.robot_point_B_m.isApprox(in_base(link.robot_point_C_m), 1e-5F));
    EXPECT_TRUE(link.obstacle_point_B_m.isApprox(in_base(link.obstacle_point_C_m), 1e-5F));
    EXPECT_NEAR((link.obstacle_point_B_m - link.robot_point_B_m).norm(), link.distance_m, 1e-5);
    EXPECT_GT(link.mean_count, 0);
    EXPECT_LE(link.mean_direction_B.norm(), 1.0001F);
    EXPECT_TRUE(link.visibility.surface.is_known());
  }
}

TEST_F(Queries, TheNearestIsTheOneThatMovesHasADistanceAndIsLeast) {
  Result result;
  result.links.resize(5);
  for (std::size_t i = 0; i < 5; ++i) result.links[i].link = std::to_string(i);
  find_nearest(result);
  EXPECT_EQ(result.nearest, -1) << "none has a distance";
  EXPECT_EQ(result.nearest_link(), nullptr);
  result.links[0].is_moved = false;
  result.links[0].distance_m = 0.1F;
  find_nearest(result);
  EXPECT_EQ(result.nearest, -1) << "no joint moves it";
  result.links[2].distance_m = 0.4F;
  result.links[3].distance_m = 0.3F;
  result.links[4].distance_m = 0.3F;
  find_nearest(result);
  EXPECT_EQ(result.nearest, 3);
  EXPECT_EQ(result.nearest_link()->link, "3");
  // A known obstacle near a link that is not seen counts as well.
  result.links[1].status = LinkStatus::not_seen;
  result.links[1].distance_m = 0;
  find_nearest(result);
  EXPECT_EQ(result.nearest, 1);
}

TEST_F(Queries, TheNearestOfAResultFollowsThatRule) {
  testing::FrameQuery query(robot_);
  const Result& result = query.ask(left_);
  ASSERT_NE(result.nearest_link(), nullptr);
  for (const LinkResult& link : result.links) {
    if (!link.is_moved) continue;
    EXPECT_LE(result.nearest_link()->distance_m, link.distance_m);
  }
  EXPECT_TRUE(result.nearest_link()->is_moved);
}

TEST_F(Queries, AFrameThatIsObservedAnewAtItsAddressIsAskedAnew) {
  testing::FrameQuery query(robot_), other(robot_);
  Frame frame;
  observe(17, frame, left_.mounted);
  const auto before = testing::distances_of(query.ask(frame));
  observe(3, frame, left_.mounted);
  const auto after = testing::distances_of(query.ask(frame));
  EXPECT_NE(after, before);
  EXPECT_EQ(after, testing::distances_of(other.ask(frame)));
}

TEST_F(Queries, WhatFramesLeaveOfSpaceIsKeptUntilOneOfThemChanges) {
  Query query(robot_);
  const double now_s = left_.stamp_s;
  const auto assembled = [&](const Frames& frames, double at_s) {
    query.ask({frames, {}, at_s});
    return query.frames().space().serial_number();
  };
  const std::uint64_t both = assembled({&left_, &right_}, now_s);
  EXPECT_EQ(assembled({&left_, &right_}, now_s), both);
  EXPECT_EQ(assembled({&left_, &right_}, now_s + 0.01), both) << "older, but not too old";
  const std::uint64_t swapped = assembled({&right_, &left_}, now_s);
  EXPECT_NE(swapped, both);
  EXPECT_EQ(assembled({&right_, &left_}, now_s), swapped);
  EXPECT_NE(assembled({&left_}, now_s), swapped);
  const std::uint64_t in_time = assembled({&left_, &right_}, now_s);
  EXPECT_NE(assembled({&left_, &right_}, now_s + 1), in_time) << "none may be used any more";
}

TEST_F(Queries, ForgettingGivesTheSameBitsAgain) {
  Query query(robot_);
  const auto first = testing::distances_of(query.ask({left_}));
  for (const std::size_t i : {3, 20, 9}) query.ask({left_, camera_.at_exposure[i]});
  query.forget();
  EXPECT_EQ(testing::distances_of(query.ask({left_})), first);
}

TEST_F(Queries, LookAheadStandsBesideTheResultItself) {
  const std::vector<JointState> path(camera_.at_exposure.begin(), camera_.at_exposure.begin() + 3);
  Query query(robot_), plain(robot_);
  const Result result = query.ask({.frames = left_, .ahead = path, .nearer_than_m = 100});
  EXPECT_EQ(result.ahead.poses.size(), 3U);
  EXPECT_EQ(result.ahead.first_nearer, 0U);
  EXPECT_EQ(testing::distances_of(result), testing::distances_of(plain.ask({left_})));
  EXPECT_EQ(result.joints_stamp_s, left_.stamp_s);
}

TEST_F(Queries, NoCameraAndNineAreRefused) {
  const auto refusal = [&](std::size_t count) {
    return error_message<std::invalid_argument>(
        [&] { Query(robot_).ask({Frames(count, &left_)}); });
  };
  EXPECT_EQ(refusal(0), "frames: 0 cameras; expected 1 to 8");
  EXPECT_EQ(refusal(9), "frames: 9 cameras; expected 1 to 8");
  EXPECT_EQ(refusal(8), "");
}

TEST_F(Queries, ABufferOfJointsNeedsTheTimeOfTheRequest) {
  const JointBuffer joints(robot_->model(), 2);
  const std::string expected =
      "now_s: none; expected the time of the request, since joints are a buffer";
  testing::FrameQuery query(robot_);
  EXPECT_EQ(error_message<std::invalid_argument>([&] { query.ask(left_, joints); }), expected);
  EXPECT_EQ(query.ask(left_, joints, left_.stamp_s).time.status, TimeStatus::no_joints);
}

}  // namespace
}  // namespace berth
