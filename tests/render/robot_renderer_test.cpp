// What a robot image holds, by scenes whose image is known. Against the twin: slow_renderer_test.
#include "berth/render/robot_renderer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <thread>

#include "berth/robot/primitives.hpp"
#include "tests/render/small_robot.hpp"
#include "tests/support/same_bits.hpp"

namespace berth {
namespace {

const Camera kTinyCamera{37, 29, 30, 30, 18, 14};

/// Seen by a camera that stands in the robot's base frame.
RobotImage render(const RobotModel& model, const std::vector<Pose>& X_CL,
                  const Camera& camera = kTinyCamera) {
  RobotImage image;
  RobotRenderer(build_link_meshes(model), camera)
      .render(pose_seen_at(Pose::Identity(), X_CL), Pose::Identity(), image);
  return image;
}

int count(const RobotImage& image, LinkId id) {
  const auto& ids = image.link_id.pixels();
  return static_cast<int>(std::count(ids.begin(), ids.end(), id));
}

TEST(RobotRenderer, DepthIsAlongTheOpticalAxisNotAlongTheRay) {
  const RobotImage image = render(robot_of({make_box({20, 20, 1})}), {at(0, 0, 2.5)});
  EXPECT_EQ(count(image, 1), 37 * 29);
  for (const float depth_m : image.depth_m.pixels()) EXPECT_NEAR(depth_m, 2, 1e-5);
}

TEST(RobotRenderer, PixelCentresAreAtIntegerCoordinates) {
  // A plate at 1 m from x = 0.1 (u = 18 + 3) to 0.2 (u = 18 + 6), and the same in y: it holds the
  // centres of 4 columns once its edges stand a little outside of them, of 2 a little inside.
  for (const auto& [margin_m, columns] : {std::pair{0.001, 4}, {-0.001, 2}}) {
    const double side_m = 0.1 + 2 * margin_m;
    const RobotImage image =
        render(robot_of({make_box({side_m, side_m, 1e-4})}), {at(0.15, 0.15, 1)});
    EXPECT_EQ(count(image, 1), columns * columns);
    EXPECT_EQ(image.link_id(22, 18), 1);
    EXPECT_EQ(image.link_id(21, 17), margin_m > 0 ? 1 : kNoLink);
  }
}

TEST(RobotRenderer, NearerLinkHidesTheOther) {
  const RobotModel model = robot_of({make_box({4, 4, 0.2}), make_box({0.2, 0.2, 0.2})});
  const RobotImage image = render(model, {at(0, 0, 3), at(0, 0, 1)});
  EXPECT_EQ(image.link_id(18, 14), 2);
  EXPECT_NEAR(image.depth_m(18, 14), 0.9, 1e-5);
  EXPECT_EQ(image.link_id(0, 0), 1);
  EXPECT_NEAR(image.depth_m(0, 0), 2.9, 1e-5);
}

TEST(RobotRenderer, EnvironmentLinkIsSeenAndHidesOthers) {
  RobotModel model = robot_of({make_box({0.5, 0.5, 0.2}), make_box({0.3, 8, 0.2})});
  set_last_role(model, LinkRole::environment);
  const RobotImage image = render(model, {at(0, 0, 2), at(0, 0, 1)});
  EXPECT_EQ(image.link_id(18, 14), kEnvironmentLink);
  EXPECT_NEAR(image.depth_m(18, 14), 0.9, 1e-5);
  EXPECT_EQ(count(image, 1), 0);
  const RobotImage beside = render(model, {at(0.5, 0, 2), at(-0.3, 0, 1)});
  EXPECT_GT(count(beside, 1), 0);
  EXPECT_GT(count(beside, kEnvironmentLink), 0);
}

TEST(RobotRenderer, IgnoredLinkIsNotSeenAndHidesNothing) {
  RobotModel model = robot_of({make_box({0.5, 0.5, 0.2}), make_box({8, 8, 0.2})});
  const int alone = count(render(robot_of({make_box({0.5, 0.5, 0.2})}), {at(0, 0, 2)}), 1);
  set_last_role(model, LinkRole::ignored);
  const RobotImage image = render(model, {at(0, 0, 2), at(0, 0, 1)});
  EXPECT_EQ(count(image, 1), alone);
  EXPECT_EQ(count(image, kNoLink), 37 * 29 - alone);
}

TEST(RobotRenderer, LinkBehindTheCameraIsNotSeen) {
  const RobotImage image = render(robot_of({make_box({1, 1, 1})}), {at(0, 0, -2)});
  EXPECT_EQ(count(image, kNoLink), 37 * 29);
  for (const float depth_m : image.depth_m.pixels()) EXPECT_TRUE(std::isnan(depth_m));
}

TEST(RobotRenderer, CameraMovesOppositeToTheRobot) {
  const RobotModel model = robot_of({make_box({0.3, 0.4, 0.5})});
  RobotRenderer renderer(build_link_meshes(model), kTinyCamera);
  std::mt19937 random(5);
  const Pose X_BC = random_pose(random, {Eigen::Vector3d(-3, -3, -3), Eigen::Vector3d(3, 3, 3)});
  RobotImage moved;
  renderer.render(pose_seen_at(X_BC, {at(0.1, 0.1, 1.5)}), X_BC, moved);
  const RobotImage still = render(model, {at(0.1, 0.1, 1.5)});
  EXPECT_EQ(moved.link_id.pixels(), still.link_id.pixels());
  for (std::size_t i = 0; i < still.depth_m.pixels().size(); ++i) {
    if (still.link_id.pixels()[i] == kNoLink) continue;
    EXPECT_NEAR(moved.depth_m.pixels()[i], still.depth_m.pixels()[i], 1e-5);
  }
}

TEST(RobotRenderer, NothingOfTheImageBeforeRemains) {
  const RobotModel model = robot_of({make_box({0.5, 0.5, 0.5}), make_sphere(0.3)});
  RobotRenderer renderer(build_link_meshes(model), kTinyCamera);
  const RobotPose a = pose_seen_at(Pose::Identity(), {at(-0.4, 0, 2), at(0.6, 0.3, 1)});
  const RobotPose b = pose_seen_at(Pose::Identity(), {at(0.4, 0.2, 1), at(0, 0, -2)});
  RobotImage first;
  renderer.render(a, Pose::Identity(), first);
  RobotImage image;
  image.depth_m.resize(100, 70, 1.5F);
  image.link_id.resize(3, 3, LinkId{9});
  for (const RobotPose* pose : {&b, &a, &b}) renderer.render(*pose, Pose::Identity(), image);
  EXPECT_FALSE(same_bits(image, first));
  EXPECT_EQ(count(image, 2), 0);
  renderer.render(a, Pose::Identity(), image);
  EXPECT_TRUE(same_bits(image, first));
}

TEST(RobotRenderer, ThreadsThatShareMeshesGetTheSameImages) {
  std::mt19937 random(11);
  const RobotModel model = robot_of(
      {make_sphere(0.3), make_box({0.2, 0.3, 0.9}), make_cylinder(0.1, 0.8), random_mesh(random)});
  const auto meshes = build_link_meshes(model);
  std::vector<RobotPose> poses;
  for (int i = 0; i < 40; ++i) {
    std::vector<Pose> X_CL;
    for (int link = 0; link < 4; ++link)
      X_CL.push_back(
          random_pose(random, {Eigen::Vector3d(-1, -1, -0.2), Eigen::Vector3d(1, 1, 3)}));
    poses.push_back(pose_seen_at(Pose::Identity(), X_CL));
  }
  const auto render_all = [&](std::vector<RobotImage>& images) {
    RobotRenderer renderer(meshes, kTinyCamera);
    images.resize(poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i)
      renderer.render(poses[i], Pose::Identity(), images[i]);
  };
  std::vector<RobotImage> alone;
  std::vector<RobotImage> left;
  std::vector<RobotImage> right;
  render_all(alone);
  std::thread left_thread([&] { render_all(left); });
  std::thread right_thread([&] { render_all(right); });
  left_thread.join();
  right_thread.join();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_TRUE(same_bits(left[i], alone[i])) << i;
    EXPECT_TRUE(same_bits(right[i], alone[i])) << i;
  }
}

TEST(RobotRenderer, MeshesOutliveTheModelTheyWereBuiltFrom) {
  std::shared_ptr<const LinkMeshes> meshes;
  {
    const RobotModel model = robot_of({make_box({20, 20, 1})});
    meshes = build_link_meshes(model);
  }
  RobotRenderer renderer(std::move(meshes), kTinyCamera);
  RobotRenderer moved = std::move(renderer);
  RobotImage image;
  moved.render(pose_seen_at(Pose::Identity(), {at(0, 0, 2.5)}), Pose::Identity(), image);
  EXPECT_EQ(count(image, 1), 37 * 29);
}

TEST(RobotRenderer, BadCameraThrows) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto meshes = build_link_meshes(robot_of({make_box({1, 1, 1})}));
  for (const Camera& bad : {Camera{}, Camera{0, 10, 5, 5, 5, 5}, Camera{10, -1, 5, 5, 5, 5},
                            Camera{10, 10, 0, 5, 5, 5}, Camera{10, 10, 5, -5, 5, 5},
                            Camera{10, 10, kNaN, 5, 5, 5}, Camera{10, 10, 5, kInfinity, 5, 5},
                            Camera{10, 10, 5, 5, kNaN, 5}, Camera{10, 10, 5, 5, 5, kInfinity}}) {
    EXPECT_THROW(RobotRenderer(meshes, bad), std::invalid_argument);
  }
}

TEST(RobotRenderer, CameraPoseThatIsNotFiniteThrowsAndLeavesTheImage) {
  const RobotModel model = robot_of({make_box({1, 1, 1})});
  RobotRenderer renderer(build_link_meshes(model), kTinyCamera);
  const RobotPose pose = pose_seen_at(Pose::Identity(), {at(0, 0, 2)});
  RobotImage image;
  renderer.render(pose, Pose::Identity(), image);
  const RobotImage before = image;
  Pose bad = Pose::Identity();
  bad.translation().z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(renderer.render(pose, bad, image), std::invalid_argument);
  EXPECT_TRUE(same_bits(image, before));
}

}  // namespace
}  // namespace berth
