// RobotRenderer against its slow twin.
#include "tests/render/slow_renderer.hpp"

#include <gtest/gtest.h>

#include "berth/render/robot_renderer.hpp"
#include "berth/robot/primitives.hpp"
#include "tests/render/comparison.hpp"
#include "tests/render/small_robot.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/thinned.hpp"

namespace berth {
namespace {

const Camera kSmallCamera{45, 35, 42, 38, 22.3, 16.8};

Comparison render_both(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
                       const Camera& camera = kSmallCamera) {
  RobotImage image;
  RobotRenderer(build_link_meshes(model), camera).render(pose, X_BC, image);
  EXPECT_EQ(image.depth_m.width(), camera.width_px);
  EXPECT_EQ(image.link_id.height(), camera.height_px);
  const SlowRenderer twin(model, pose, X_BC, camera);
  const Comparison result = compare(image, [&](double u, double v) { return twin.hit(u, v); });
  EXPECT_TRUE(result.wrong.empty()) << result.wrong.size() << " pixels, the first at "
                                    << result.wrong[0].u << " " << result.wrong[0].v;
  EXPECT_EQ(result.ties, 0);
  return result;
}

/// A camera that stands anywhere, and one link at `X_CL` in its frame.
Comparison render_one(const TriangleMesh& mesh, const Pose& X_CL) {
  std::mt19937 random(7);
  const Pose X_BC = random_pose(random, {Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1)});
  return render_both(robot_of({mesh}), pose_seen_at(X_BC, {X_CL}), X_BC);
}

struct RandomRobot {
  RobotModel model;
  std::vector<Pose> X_CL;
};

/// Four links, some of which stand behind the camera, around it, or outside of the image.
RandomRobot random_robot(std::mt19937& random) {
  std::vector<TriangleMesh> meshes;
  std::vector<Pose> X_CL;
  for (int i = 0; i < 4; ++i) {
    meshes.push_back(random_mesh(random));
    X_CL.push_back(
        random_pose(random, {Eigen::Vector3d(-1.2, -1, -0.7), Eigen::Vector3d(1.2, 1, 3)}));
  }
  return {robot_of(std::move(meshes)), std::move(X_CL)};
}

Pose random_camera(std::mt19937& random) {
  return random_pose(random, {Eigen::Vector3d(-2, -2, -2), Eigen::Vector3d(2, 2, 2)});
}

TEST(RendererAndTwin, AgreeOnRandomRobots) {
  std::mt19937 random(42);
  Comparison sum;
  for (int trial = 0; trial < thinned(25); ++trial) {
    SCOPED_TRACE(trial);
    auto [model, X_CL] = random_robot(random);
    if (trial % 4 == 1) set_last_role(model, LinkRole::environment);
    if (trial % 4 == 2) set_last_role(model, LinkRole::ignored);
    const Pose X_BC = random_camera(random);
    const Comparison result = render_both(model, pose_seen_at(X_BC, X_CL), X_BC);
    sum.pixels += result.pixels;
    sum.robot_pixels += result.robot_pixels;
    sum.at_edges += result.at_edges;
  }
  RecordProperty("at_edges", sum.at_edges);
  RecordProperty("robot_pixels", sum.robot_pixels);
  EXPECT_GT(sum.robot_pixels, sum.pixels / 10) << "the test shows too little of the robots";
  // With other draws 0.8 to 1.9 of 1000.
  EXPECT_LE(sum.at_edges, sum.robot_pixels / 300);
}

/// What lies behind the first surface of each ray, by both.
Comparison render_both_behind(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
                              const Camera& camera) {
  RobotImage first, image;
  RobotRenderer renderer(build_link_meshes(model), camera);
  renderer.render(pose, X_BC, first);
  renderer.render_behind(pose, X_BC, first, image);
  const SlowRenderer twin(model, pose, X_BC, camera);
  const Comparison result = compare(image, [&](double u, double v) {
    const sim::RayHit hit = twin.hit(u, v);
    return hit.id == kNoLink ? hit : twin.hit_beyond(u, v, hit.depth_m * (1 + 1e-5));
  });
  EXPECT_TRUE(result.wrong.empty()) << result.wrong.size() << " pixels, the first at "
                                    << result.wrong[0].u << " " << result.wrong[0].v;
  return result;
}

TEST(RendererAndTwin, AgreeOnWhatLiesBehindTheFirstSurface) {
  std::mt19937 random(43);
  Comparison sum;
  for (int trial = 0; trial < 25; ++trial) {
    SCOPED_TRACE(trial);
    const auto [model, X_CL] = random_robot(random);
    const Pose X_BC = random_camera(random);
    const Comparison result =
        render_both_behind(model, pose_seen_at(X_BC, X_CL), X_BC, kSmallCamera);
    sum.robot_pixels += result.robot_pixels;
    sum.at_edges += result.at_edges;
  }
  RecordProperty("at_edges", sum.at_edges);
  RecordProperty("robot_pixels", sum.robot_pixels);
  EXPECT_GT(sum.robot_pixels, 1000);
  EXPECT_LE(sum.at_edges, sum.robot_pixels / 200);
}

TEST(RobotRenderer, NothingOfWhatLiesBehindStaysForTheNextImage) {
  const RobotModel model = robot_of({make_box({0.4, 0.3, 0.2})});
  RobotRenderer renderer(build_link_meshes(model), kSmallCamera);
  RobotImage first, behind, again;
  const RobotPose pose = pose_seen_at(Pose::Identity(), {at(0, 0, 1)});
  renderer.render(pose, Pose::Identity(), first);
  renderer.render_behind(pose, Pose::Identity(), first, behind);
  EXPECT_NEAR(first.depth_m(22, 17), 0.9, 1e-5);
  EXPECT_NEAR(behind.depth_m(22, 17), 1.1, 1e-5);
  renderer.render(pose, Pose::Identity(), again);
  EXPECT_EQ(again.link_id.pixels(), first.link_id.pixels());
  EXPECT_EQ(again.depth_m(22, 17), first.depth_m(22, 17));
}

TEST(RendererAndTwin, AgreeAtImageSizesOfAnyRemainder) {
  std::mt19937 random(3);
  const RobotModel model = robot_of({make_sphere(0.8), make_box({1, 0.3, 0.2})});
  const RobotPose pose = pose_seen_at(Pose::Identity(), {at(0.2, 0, 1.5), at(-0.6, 0.3, 1)});
  for (const auto& [width, height] :
       {std::pair{1, 1}, {2, 9}, {3, 5}, {4, 4}, {7, 8}, {8, 7}, {9, 17}, {13, 31}, {40, 24}}) {
    SCOPED_TRACE(width);
    const Camera camera{
        width, height, width / 1.2, height / 1.1, (width - 1) / 2.0, (height - 1) / 2.0};
    EXPECT_GT(render_both(model, pose, Pose::Identity(), camera).robot_pixels, 0);
  }
}

TEST(RendererAndTwin, AgreeOnABoxThatReachesBehindTheCamera) {
  // Beside the camera from z = -1 to 3: its near corners do not project.
  const Comparison result = render_one(make_box({0.1, 0.1, 4}), at(0.2, 0.1, 1));
  EXPECT_GT(result.robot_pixels, 50);
}

TEST(RendererAndTwin, AgreeWithTheCameraInsideALink) {
  for (const TriangleMesh& mesh : {make_box({1, 1, 1}), make_sphere(0.4)}) {
    const Comparison result = render_one(mesh, at(0.05, -0.1, 0.02));
    EXPECT_EQ(result.robot_pixels, result.pixels);
  }
}

TEST(RendererAndTwin, AgreeOnTrianglesThroughTheCamerasPlane) {
  std::mt19937 random(8);
  int robot_pixels = 0;
  int at_edges = 0;
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(trial);
    // All three corners of a triangle lie anywhere around the camera, near ones among them.
    TriangleMesh mesh;
    std::normal_distribution<float> normal;
    for (std::uint32_t i = 0; i < 6; ++i) {
      const float size_m = std::pow(10.0F, -static_cast<float>(random() % 4));
      for (int corner = 0; corner < 3; ++corner)
        mesh.vertices_m.push_back(size_m *
                                  Eigen::Vector3f(normal(random), normal(random), normal(random)));
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const Comparison result = render_one(mesh, Pose::Identity());
    robot_pixels += result.robot_pixels;
    at_edges += result.at_edges;
  }
  EXPECT_GT(robot_pixels, 10000);
  EXPECT_LE(at_edges, robot_pixels / 1000);
}

TEST(RendererAndTwin, AgreeOnALinkVeryNearTheCamera) {
  EXPECT_GT(render_one(make_box({2e-3, 2e-3, 4e-4}), at(0, 0, 4e-4)).robot_pixels, 100);
  EXPECT_GT(render_one(make_box({0.1, 0.1, 0.01}), at(0, 0, 0.011)).robot_pixels, 100);
}

TEST(RendererAndTwin, AgreeOnALinkPartlyOutsideTheImage) {
  for (const auto& [x_m, y_m] :
       {std::pair{0.55, 0.0}, {-0.55, 0.0}, {0.0, 0.47}, {0.0, -0.47}, {0.55, 0.47}}) {
    const Comparison result = render_one(make_box({0.3, 0.3, 0.3}), at(x_m, y_m, 1));
    EXPECT_GT(result.robot_pixels, 10);
    EXPECT_LT(result.robot_pixels, 400);
  }
}

TEST(RendererAndTwin, AgreeOnALinkFarAway) {
  EXPECT_GT(render_one(make_sphere(20), at(5, -3, 90)).robot_pixels, 100);
}

TEST(RendererAndTwin, AgreeOnARealRobot) {
  const auto urdf = data_folder() / "robots/kuka_lwr4_bullet/kuka.urdf";
  if (!std::filesystem::exists(urdf)) GTEST_SKIP() << "no " << urdf << "; set BERTH_DATA";
  const RobotModel model = load_robot({.urdf = urdf});
  RobotPose pose;
  forward_kinematics(model, {0.3, 0.7, -0.4, 1.2, 0.5, -0.8, 0.1}, pose);
  Pose X_BC = at(1.1, 0.1, 0.5);
  X_BC.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  const Comparison result = render_both(model, pose, X_BC);
  EXPECT_GT(result.robot_pixels, 150);
  EXPECT_LE(result.at_edges, 3);
}

}  // namespace
}  // namespace berth
