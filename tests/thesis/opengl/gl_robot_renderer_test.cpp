// The robot as the GPU draws it, against RobotRenderer.
#include "thesis/opengl/gl_robot_renderer.hpp"

#include <fmt/format.h>

#include <limits>

#include "berth/render/robot_renderer.hpp"
#include "berth/robot/primitives.hpp"
#include "tests/render/crowded_robot.hpp"
#include "tests/render/small_robot.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/gl_test.hpp"
#include "tests/thesis/opengl/robot_difference.hpp"

namespace berth {
namespace {

/// Of the pixels that show a robot: of large shapes, and of many small triangles.
constexpr double kMostAtEdges = 0.003;
constexpr double kMostAtEdgesOfMeshes = 0.003;

const Camera kCamera{97, 75, 90, 80, 41.3, 30.2};

class GlRobotRendererTest : public testing::GlTest {};

Pose at(double x_m, double y_m, double z_m) { return Pose(Eigen::Translation3d(x_m, y_m, z_m)); }

RobotImage render_on_gpu(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
                         const Camera& camera, const GlEnlargement& enlargement = {}) {
  const GlRobotImage on_gpu(camera.width_px, camera.height_px);
  GlRobotRenderer(model, camera).render(pose, X_BC, enlargement, on_gpu);
  RobotImage image;
  read_back(on_gpu, image);
  return image;
}

RobotImage render_on_cpu(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
                         const Camera& camera) {
  RobotImage image;
  RobotRenderer(build_link_meshes(model), camera).render(pose, X_BC, image);
  return image;
}

RobotDifference compare(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
                        const Camera& camera) {
  return difference(render_on_gpu(model, pose, X_BC, camera),
                    render_on_cpu(model, pose, X_BC, camera));
}

void print(const std::string& name, const RobotDifference& d) {
  fmt::print(
      "{}: {} robot pixels, {} differ at edges ({:.3f} %), {} elsewhere, depth error {:.1e}\n",
      name, d.robot_pixels, d.at_edges, 100 * d.edge_share(), d.wrong.size(), d.depth_error);
}

TEST_F(GlRobotRendererTest, ShapesAtAnyPlaceLookAsOnTheCpu) {
  std::mt19937 random(3);
  RobotDifference sum;
  for (int scene = 0; scene < 60; ++scene) {
    std::vector<TriangleMesh> meshes;
    std::vector<Pose> X_CL;
    for (int link = 0; link < 4; ++link) {
      meshes.push_back(random_mesh(random));
      // Some reach behind the camera.
      X_CL.push_back(
          random_pose(random, {Eigen::Vector3d(-1, -1, -0.3), Eigen::Vector3d(1, 1, 3)}));
    }
    const Pose X_BC = random_pose(random, {Eigen::Vector3d(-3, -3, -3), Eigen::Vector3d(3, 3, 3)});
    const RobotDifference d =
        compare(robot_of(std::move(meshes)), pose_seen_at(X_BC, X_CL), X_BC, kCamera);
    EXPECT_TRUE(d.wrong.empty()) << "scene " << scene << ", pixel " << d.wrong.front().u << ", "
                                 << d.wrong.front().v;
    sum.robot_pixels += d.robot_pixels;
    sum.at_edges += d.at_edges;
    sum.depth_error = std::max(sum.depth_error, d.depth_error);
    sum.wrong.insert(sum.wrong.end(), d.wrong.begin(), d.wrong.end());
  }
  print("60 scenes of shapes", sum);
  EXPECT_GT(sum.robot_pixels, 50000);
  EXPECT_LE(sum.edge_share(), kMostAtEdges);
}

TEST_F(GlRobotRendererTest, ACrowdOfSmallTrianglesLooksAsOnTheCpu) {
  const CrowdedRobot robot(5);
  const Camera camera{320, 240, 300, 310, 150.2, 121.7};
  const RobotDifference d = compare(robot.model, robot.pose, Pose::Identity(), camera);
  print("crowd", d);
  EXPECT_GT(d.robot_pixels, 20000);
  EXPECT_TRUE(d.wrong.empty());
  EXPECT_LE(d.edge_share(), kMostAtEdgesOfMeshes);
}

TEST_F(GlRobotRendererTest, TheSmallerIdWinsWhereTwoLinksAreInOnePlace) {
  const RobotModel model = robot_of({make_box({1, 1, 1}), make_box({1, 1, 1})});
  const RobotImage image = render_on_gpu(
      model, pose_seen_at(Pose::Identity(), {at(0, 0, 2), at(0, 0, 2)}), Pose::Identity(), kCamera);
  EXPECT_EQ(image.link_id(41, 30), 1);
  for (const LinkId id : image.link_id.pixels()) EXPECT_NE(id, 2);
}

TEST_F(GlRobotRendererTest, EnvironmentIsSeenAndIgnoredLinksAreNot) {
  for (const auto& [role, seen] :
       {std::pair{LinkRole::environment, kEnvironmentLink}, {LinkRole::ignored, LinkId{1}}}) {
    RobotModel model = robot_of({make_box({2, 2, 0.2}), make_box({0.3, 0.3, 0.2})});
    set_last_role(model, role);
    const RobotImage image =
        render_on_gpu(model, pose_seen_at(Pose::Identity(), {at(0, 0, 2), at(0, 0, 1)}),
                      Pose::Identity(), kCamera);
    EXPECT_EQ(image.link_id(41, 30), seen);
  }
}

TEST_F(GlRobotRendererTest, AWallThatPassesTheCameraIsSeenFromZOn) {
  const RobotModel model = robot_of({make_box({0.2, 4, 10})});
  const RobotPose pose = pose_seen_at(Pose::Identity(), {at(0.3, 0, 2)});
  const RobotDifference d = compare(model, pose, Pose::Identity(), kCamera);
  EXPECT_GT(d.robot_pixels, 1000);
  EXPECT_TRUE(d.wrong.empty());
  EXPECT_LE(d.edge_share(), kMostAtEdges);
}

TEST_F(GlRobotRendererTest, NothingOfTheImageBeforeRemains) {
  const RobotModel model = robot_of({make_box({0.5, 0.5, 0.5}), make_sphere(0.3)});
  GlRobotRenderer renderer(model, kCamera);
  const GlRobotImage on_gpu(kCamera.width_px, kCamera.height_px);
  RobotImage image;
  for (const double x_m : {-0.4, 0.4, -0.3}) {
    const RobotPose pose = pose_seen_at(Pose::Identity(), {at(x_m, 0, 2), at(0, 0, -2)});
    renderer.render(pose, Pose::Identity(), on_gpu);
    read_back(on_gpu, image);
    EXPECT_EQ(image.link_id.pixels(),
              render_on_gpu(model, pose, Pose::Identity(), kCamera).link_id.pixels());
  }
}

TEST_F(GlRobotRendererTest, AScaledModelIsScaledAboutEachLinksCentre) {
  TriangleMesh beside;
  beside.append(make_box({0.2, 0.3, 0.1}), Eigen::Affine3d(Eigen::Translation3d(0.4, 0, 0)));
  TriangleMesh larger;
  larger.append(make_box({0.6, 0.9, 0.3}), Eigen::Affine3d(Eigen::Translation3d(0.4, 0, 0)));
  const RobotPose pose = pose_seen_at(Pose::Identity(), {at(-0.3, 0.1, 2)});
  const RobotDifference d =
      difference(render_on_gpu(robot_of({beside}), pose, Pose::Identity(), kCamera, {3, 0}),
                 render_on_cpu(robot_of({larger}), pose, Pose::Identity(), kCamera));
  EXPECT_GT(d.robot_pixels, 500);
  EXPECT_TRUE(d.wrong.empty());
  EXPECT_LE(d.at_edges, 8);
}

TEST_F(GlRobotRendererTest, NormalPaddingMovesASpheresSurfaceOutward) {
  const RobotPose pose = pose_seen_at(Pose::Identity(), {at(0.1, 0.1, 1.5)});
  const RobotImage grown =
      render_on_gpu(robot_of({make_sphere(0.3)}), pose, Pose::Identity(), kCamera, {1, 0.05});
  const RobotImage larger =
      render_on_cpu(robot_of({make_sphere(0.35)}), pose, Pose::Identity(), kCamera);
  int differ = 0;
  for (std::size_t i = 0; i < grown.link_id.pixels().size(); ++i) {
    differ += grown.link_id.pixels()[i] != larger.link_id.pixels()[i];
    if (grown.link_id.pixels()[i] == kNoLink || larger.link_id.pixels()[i] == kNoLink) continue;
    EXPECT_NEAR(grown.depth_m.pixels()[i], larger.depth_m.pixels()[i], 0.01);
  }
  EXPECT_LE(differ, 20);
}

TEST_F(GlRobotRendererTest, WhatIsNotFiniteOrNoCameraIsRefused) {
  const RobotModel model = robot_of({make_box({1, 1, 1})});
  EXPECT_THROW(GlRobotRenderer(model, Camera{10, 10, 0, 5, 5, 5}), std::invalid_argument);
  GlRobotRenderer renderer(model, kCamera);
  const GlRobotImage image(kCamera.width_px, kCamera.height_px);
  const RobotPose pose = pose_seen_at(Pose::Identity(), {at(0, 0, 2)});
  Pose bad = Pose::Identity();
  bad.translation().z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(renderer.render(pose, bad, image), std::invalid_argument);
  EXPECT_THROW(renderer.render(pose, Pose::Identity(), {0.5, 0}, image), std::invalid_argument);
  EXPECT_THROW(renderer.render(pose, Pose::Identity(), {1, -0.1}, image), std::invalid_argument);
}

TEST_F(GlRobotRendererTest, RealRobotsLookAsOnTheCpu) {
  const auto folder = data_folder() / "robots";
  if (!std::filesystem::is_directory(folder))
    GTEST_SKIP() << "no real robots in " << folder << "; set BERTH_DATA";
  const Camera camera{640, 480, 610, 612, 322.4, 236.1};
  std::mt19937 random(9);
  for (const char* urdf : {"xarm7/xarm7_with_gripper.urdf", "kuka_lbr_med7/lbr_med7.urdf",
                           "franka_panda/panda.urdf", "pr2/pr2.urdf"}) {
    const RobotModel model = load_robot({folder / urdf});
    RobotPose pose;
    forward_kinematics(model, std::vector<double>(model.joints.size(), 0.3), pose);
    const Pose X_CB =
        random_pose(random, {Eigen::Vector3d(-0.2, -0.2, 1.2), Eigen::Vector3d(0.2, 0.2, 1.6)});
    const RobotDifference d = compare(model, pose, X_CB.inverse(), camera);
    print(urdf, d);
    EXPECT_GT(d.robot_pixels, 5000) << urdf;
    EXPECT_LE(d.edge_share(), kMostAtEdgesOfMeshes) << urdf;
    EXPECT_TRUE(d.wrong.empty()) << urdf << ": " << d.wrong.size();
  }
}

}  // namespace
}  // namespace berth
