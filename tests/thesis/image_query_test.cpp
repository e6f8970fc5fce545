// Requests about the images of one frame.
#include "thesis/image_query.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "berth/pipeline/observer.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/support/error_message.hpp"
#include "thesis/evaluate.hpp"

namespace berth {
namespace {

class ImageQueries : public ::testing::Test {
 protected:
  ImageQueries()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()) {
    observe(3, frame_);
  }

  void observe(std::size_t i, Frame& frame, FrameTime time = {}) const {
    Observer(camera_.mounted).observe(camera_.read_depth(i), camera_.at_exposure[i], frame, time);
  }
  static std::vector<float> distances_of(const ImageResult& result) {
    std::vector<float> distances;
    for (const LinkResult& link : result.links) distances.push_back(link.distance_m);
    return distances;
  }
  void expect_withheld(const ImageResult& result, TimeStatus status) const {
    EXPECT_EQ(result.status, ResultStatus::stale);
    EXPECT_EQ(result.time.status, status) << name_of(result.time.status);
    EXPECT_EQ(result.pairs, 0);
    EXPECT_EQ(result.nearest, -1);
    EXPECT_TRUE(result.pose.X_BL.empty());
    ASSERT_EQ(result.links.size(), scene_.robot->model().evaluated_links.size());
    ASSERT_EQ(result.pairs_of.size(), result.links.size());
    for (std::size_t i = 0; i < result.links.size(); ++i) {
      EXPECT_EQ(result.links[i].status, LinkStatus::stale);
      EXPECT_TRUE(std::isnan(result.links[i].distance_m));
      EXPECT_TRUE(std::isnan(result.links[i].lower_bound_m));
      EXPECT_TRUE(result.links[i].robot_point_B_m.hasNaN());
      EXPECT_EQ(result.pairs_of[i].robot_pixel, Pixel());
    }
  }

  OpenScene scene_;
  const OpenCamera& camera_;
  Frame frame_;
};

TEST_F(ImageQueries, LinksHaveNamesPixelsAndPointsInBothFrames) {
  for (const Method method : kCpuMethods) {
    ImageQuery query(scene_.robot, method);
    const ImageResult& result = query.ask(frame_);
    EXPECT_EQ(result.method, method);
    EXPECT_EQ(result.status, ResultStatus::ok);
    EXPECT_FALSE(result.has_visibility);
    EXPECT_GT(result.pairs, 0);
    ASSERT_NE(result.nearest_link(), nullptr);
    const std::vector<std::string> names = scene_.robot->model().evaluated_link_names();
    ASSERT_EQ(result.links.size(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      const LinkResult& link = result.links[i];
      EXPECT_EQ(link.link, names[i]);
      ASSERT_EQ(link.status, LinkStatus::ok);
      EXPECT_EQ(result.camera_of(link), camera_.source.name);
      const Pixel at = result.pairs_of[i].robot_pixel;
      EXPECT_EQ(frame_.robot.link_id(at.u, at.v), link.id);
      EXPECT_GT(result.pairs_of[i].robot_pixels, 0);
      const auto in_base = [&](const Eigen::Vector3f& p_C) -> Eigen::Vector3f {
        return (frame_.X_BC * p_C.cast<double>()).cast<float>();
      };
      EXPECT_TRUE(link.robot_point_B_m.isApprox(in_base(link.robot_point_C_m), 1e-5F));
      EXPECT_TRUE(link.obstacle_point_B_m.isApprox(in_base(link.obstacle_point_C_m), 1e-5F));
      EXPECT_NEAR((link.obstacle_point_B_m - link.robot_point_B_m).norm(), link.distance_m, 1e-5);
      EXPECT_GT(link.mean_count, 0);
      if (!link.is_moved) continue;
      EXPECT_LE(result.nearest_link()->distance_m, link.distance_m);
    }
  }
}

TEST_F(ImageQueries, OtherJointsGiveTheImageOfThatPoseAgainstWhatTheFrameSaw) {
  const JointState next = camera_.at_exposure[20];
  ImageQuery query(scene_.robot, Method::exact);
  const auto at_exposure = distances_of(query.ask(frame_));
  EXPECT_EQ(distances_of(query.ask(frame_, camera_.at_exposure[3])), at_exposure);
  const ImageResult& result = query.ask(frame_, next);
  EXPECT_EQ(result.stamp_s, camera_.at_exposure[3].stamp_s);
  EXPECT_EQ(result.joints_stamp_s, next.stamp_s);
  const RobotModel& model = scene_.robot->model();
  RobotPose pose;
  forward_kinematics(model, next.position, pose);
  RobotImage robot;
  RobotRenderer(scene_.robot->meshes(), camera_.mounted->camera()).render(pose, frame_.X_BC, robot);
  SearchableDepth obstacles;
  obstacles.build(frame_.obstacles.depth_m);
  EvaluateWorkspace workspace;
  LinkDistances expected;
  evaluate(Method::exact, {camera_.mounted->camera(), robot, model.link_count(), obstacles, {}},
           workspace, expected);
  for (std::size_t i = 0; i < expected.links.size(); ++i) {
    EXPECT_EQ(result.links[i].distance_m, expected.links[i].distance_m);
  }
  EXPECT_NE(distances_of(result), at_exposure);
}

TEST_F(ImageQueries, AFrameThatIsObservedAnewAtItsAddressIsAskedAnew) {
  ImageQuery query(scene_.robot, Method::exact), other(scene_.robot, Method::exact);
  const auto before = distances_of(query.ask(frame_));
  observe(17, frame_);
  const auto after = distances_of(query.ask(frame_));
  EXPECT_NE(after, before);
  EXPECT_EQ(after, distances_of(other.ask(frame_)));
}

TEST_F(ImageQueries, AResultIsWithheldWhereStampsAgesOrTheCameraAllowNone) {
  ImageQuery query(scene_.robot, Method::exact);
  ASSERT_EQ(query.ask(frame_).status, ResultStatus::ok);
  expect_withheld(query.ask(frame_, {}, frame_.stamp_s + 10), TimeStatus::stale_frame);
  Frame skewed, moved;
  observe(3, skewed, {.status = TimeStatus::skewed});
  expect_withheld(query.ask(skewed), TimeStatus::skewed);
  observe(3, moved);
  moved.watch.has_moved = true;
  expect_withheld(query.ask(moved), TimeStatus::camera_moved);
  moved.watch = {};
  moved.watch.is_implausible = true;
  expect_withheld(query.ask(moved), TimeStatus::camera_implausible);
  expect_withheld(query.ask(Frame()), TimeStatus::no_frame);
  EXPECT_EQ(query.ask(frame_).status, ResultStatus::ok) << "a refusal leaves nothing behind";
}

TEST_F(ImageQueries, ABufferOfJointsNeedsTheTimeOfTheRequest) {
  const JointBuffer joints(scene_.robot->model(), 2);
  ImageQuery query(scene_.robot, Method::exact);
  EXPECT_EQ(error_message<std::invalid_argument>([&] { query.ask(frame_, joints); }),
            "now_s: none; expected the time of the request, since joints are a buffer");
  EXPECT_EQ(query.ask(frame_, joints, frame_.stamp_s).time.status, TimeStatus::no_joints);
  EXPECT_THROW(query.ask(frame_, JointState{0, {1, 2}}), std::invalid_argument);
}

}  // namespace
}  // namespace berth
