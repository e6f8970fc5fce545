// Cameras that move on their link, and a robot whose root moves in the world.
#include <gtest/gtest.h>

#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/robot/joint_buffer.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth {
namespace {

constexpr std::size_t kFrame = 17;
using Frames = std::vector<const Frame*>;

Pose moved_by(double x_m, double turn_rad) {
  return Eigen::Translation3d(x_m, -x_m / 3, 0.1 * x_m) *
         Pose(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()));
}

class PlaceAtExposureOf : public ::testing::Test {
 protected:
  PlaceAtExposureOf()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()) {}

  std::shared_ptr<const MountedCamera> view_turned(double turn_rad) const {
    CameraMount mount = camera_.mounted->mount();
    mount.X_PC.rotate(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitY()));
    return std::make_shared<const MountedCamera>(scene_.robot, mount, CameraSettings{});
  }
  Frame observed(const std::shared_ptr<const MountedCamera>& mounted,
                 const PlaceAtExposure& place = {}, std::size_t i = kFrame) const {
    Frame frame;
    Observer(mounted).observe(camera_.read_depth(i), camera_.at_exposure[i], frame, {}, place);
    return frame;
  }
  static void expect_same(const Result& a, const Result& b, float within_m) {
    ASSERT_EQ(a.links.size(), b.links.size());
    EXPECT_EQ(a.status, b.status);
    for (std::size_t i = 0; i < a.links.size(); ++i) {
      SCOPED_TRACE(a.links[i].link);
      EXPECT_EQ(a.links[i].status, b.links[i].status);
      ASSERT_EQ(a.links[i].has_distance(), b.links[i].has_distance());
      if (!a.links[i].has_distance()) continue;
      EXPECT_NEAR(a.links[i].distance_m, b.links[i].distance_m, within_m);
      EXPECT_NEAR(a.links[i].lower_bound_m, b.links[i].lower_bound_m, within_m);
      EXPECT_NEAR(a.links[i].visibility.surface.seen, b.links[i].visibility.surface.seen, 0.02);
    }
  }

  OpenScene scene_;
  const OpenCamera& camera_;
};

TEST_F(PlaceAtExposureOf, ACameraIsWhereItIsToldAndNotWhereItsMountSays) {
  const Frame right = observed(view_turned(0));
  const Frame told = observed(view_turned(0.1), {.X_PC = camera_.mounted->mount().X_PC});
  EXPECT_EQ(told.X_BC.matrix(), right.X_BC.matrix());
  EXPECT_EQ(told.obstacles.count, right.obstacles.count);
  const Result expected = Query(scene_.robot).ask({right});
  EXPECT_EQ(expected.status, ResultStatus::ok);
  Query query(scene_.robot);
  expect_same(query.ask({told}), expected, 0);
  EXPECT_NE(observed(view_turned(0.1)).obstacles.count, right.obstacles.count);
}

TEST_F(PlaceAtExposureOf, WithoutAPlaceNothingIsKnown) {
  JointBuffer joints(scene_.robot->model(), 100);
  std::vector<std::string> names;
  for (const MovableJoint& joint : scene_.robot->model().joints) names.push_back(joint.name);
  const JointState& at = camera_.at_exposure[kFrame];
  for (const double before_s : {0.01, -0.01}) {
    ASSERT_EQ(joints.push(at.stamp_s - before_s, names, at.position), TimeStatus::ok);
  }
  Observer observer(camera_.mounted);
  Frame lost;
  observer.observe(camera_.read_depth(kFrame), at.stamp_s, joints, lost, 0, std::nullopt);
  EXPECT_EQ(lost.time.status, TimeStatus::stale_pose);
  EXPECT_FALSE(lost.X_BC.matrix().allFinite());

  Query query(scene_.robot);
  const Result& alone = query.ask({lost});
  EXPECT_EQ(alone.status, ResultStatus::stale);
  EXPECT_EQ(alone.time.status, TimeStatus::stale_pose);
  EXPECT_EQ(alone.cameras[0].status, CameraStatus::stale_pose);
  const Frame other = observed(view_turned(0));
  const Result& beside = query.ask({Frames{&other, &lost}});
  EXPECT_EQ(beside.status, ResultStatus::degraded);
  EXPECT_EQ(beside.cameras[1].status, CameraStatus::stale_pose);
}

TEST_F(PlaceAtExposureOf, ARootThatHasMovedSinceIsFartherFromWhatWasSeen) {
  const Pose X_WB_then = moved_by(0.3, 0.2);
  const Pose X_WB_now = moved_by(0.35, 0.25);
  const Frame frame = observed(camera_.mounted, {.X_WB = X_WB_then});
  // The twin: a root that stands still, and a camera that was carried the other way.
  Frame carried = observed(camera_.mounted);
  carried.X_BC = X_WB_now.inverse() * X_WB_then * carried.X_BC;
  const Result expected = Query(scene_.robot).ask({carried});

  Query query(scene_.robot);
  const Frame still_frame = observed(camera_.mounted);
  const Result still = query.ask({frame});
  expect_same(still, Query(scene_.robot).ask({still_frame}), 0);
  const Result& moved = query.ask({.frames = frame, .X_WB = X_WB_now});
  expect_same(moved, expected, 0.002F);
  EXPECT_TRUE(moved.cameras[0].X_BC.isApprox(carried.X_BC, 1e-9));
  EXPECT_GT(std::abs(moved.nearest_link()->distance_m - still.nearest_link()->distance_m), 0.005);
  expect_same(query.ask({frame}), still, 0.002F);
}

TEST_F(PlaceAtExposureOf, FramesOfOtherTimesArePlacedWhereTheRootWasThen) {
  const Pose X_WB_1 = moved_by(0.2, 0.1);
  const Pose X_WB_2 = moved_by(0.25, 0.12);
  const Frame older = observed(view_turned(0), {.X_WB = X_WB_1}, kFrame - 1);
  const Frame newer = observed(view_turned(0), {.X_WB = X_WB_2});
  FrameSet set;
  set.assign(Frames{&older, &newer}, scene_.robot->settings().time);
  EXPECT_EQ(set.X_BC(1).matrix(), newer.X_BC.matrix()) << "the newest root counts";
  // A point of the older image stays where it was in the world.
  const Eigen::Vector3d p_C(0.1, 0.2, 1.5);
  EXPECT_TRUE((X_WB_2 * set.X_BC(0) * p_C).isApprox(X_WB_1 * older.X_BC * p_C, 1e-12));
}

TEST_F(PlaceAtExposureOf, WhereNobodyKnowsTheRootThereIsNoDistance) {
  const Frame frame = observed(camera_.mounted);
  Query query(scene_.robot);
  const Result& result = query.ask({.frames = frame, .X_WB = unset_pose()});
  EXPECT_EQ(result.status, ResultStatus::stale);
  EXPECT_EQ(result.time.status, TimeStatus::stale_pose);
  for (const LinkResult& link : result.links) EXPECT_FALSE(link.has_distance());
  EXPECT_EQ(query.ask({frame}).status, ResultStatus::ok);
}

}  // namespace
}  // namespace berth
