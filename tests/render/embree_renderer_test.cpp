// RobotRenderer against Embree, on robots with many triangles.
#include "sim/embree_renderer.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>

#include "berth/render/robot_renderer.hpp"
#include "tests/render/comparison.hpp"
#include "tests/render/small_robot.hpp"
#include "tests/support/data_folder.hpp"

namespace berth {
namespace {

const Camera kCamera{320, 240, 290, 295, 158.7, 121.2};

/// A pose at this distance from `target_B` that looks at it.
Pose looking_at(const Eigen::Vector3d& target_B, double distance_m, std::mt19937& random) {
  Pose X_BC = random_pose(random, {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  X_BC.translation() = target_B - distance_m * X_BC.linear().col(2);
  return X_BC;
}

Eigen::AlignedBox3d box_B_m(const RobotModel& model, const RobotPose& pose) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    for (const auto& vertex : model.links[i].mesh_L.vertices_m)
      box.extend(pose.X_BL[i] * vertex.cast<double>());
  }
  return box;
}

/// Random joints; the camera stands around the robot, near it, and inside.
void expect_agreement(const RobotModel& model, std::uint32_t seed, double most_ties = 0.001) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle_rad(-1.5, 1.5);
  Comparison sum;
  for (const double distance_in_sizes : {1.0, 0.7, 0.4, 0.15, 0.02}) {
    std::vector<double> positions(model.joints.size());
    for (double& position : positions) position = angle_rad(random);
    RobotPose pose;
    forward_kinematics(model, positions, pose);
    const Eigen::AlignedBox3d box = box_B_m(model, pose);
    const Pose X_BC = looking_at(box.center(), distance_in_sizes * box.diagonal().norm(), random);
    RobotImage image;
    RobotRenderer(build_link_meshes(model), kCamera).render(pose, X_BC, image);
    const sim::EmbreeRenderer twin(model, pose, X_BC, kCamera);
    const Comparison result = compare(image, [&](double u, double v) { return twin.hit(u, v); });
    EXPECT_TRUE(result.wrong.empty()) << result.wrong.size() << " pixels at " << distance_in_sizes;
    sum.robot_pixels += result.robot_pixels;
    sum.at_edges += result.at_edges;
    sum.ties += result.ties;
  }
  testing::Test::RecordProperty("at_edges", sum.at_edges);
  testing::Test::RecordProperty("ties", sum.ties);
  testing::Test::RecordProperty("robot_pixels", sum.robot_pixels);
  EXPECT_GT(sum.robot_pixels, 10000);
  EXPECT_LE(sum.at_edges, sum.robot_pixels / 1000);
  EXPECT_LE(sum.ties, most_ties * sum.robot_pixels);
}

TEST(RendererAndEmbree, AgreeOnTheBundledRobot) {
  expect_agreement(load_robot({.urdf = BERTH_BUNDLED_ARM "/arm.urdf",
                               .package_paths = {{"berth_arm", BERTH_BUNDLED_ARM}}}),
                   1);
}

class RendererAndEmbreeOn : public testing::TestWithParam<const char*> {};

TEST_P(RendererAndEmbreeOn, Agree) {
  const auto urdf = data_folder() / "robots" / GetParam();
  if (!std::filesystem::exists(urdf)) GTEST_SKIP() << "no " << urdf << "; set BERTH_DATA";
  // Two links of WidowX have a surface in one place, which fills 7 % of some images.
  const bool has_ties = urdf.filename() == "widowx.urdf";
  expect_agreement(load_robot({.urdf = urdf}), 2, has_ties ? 0.1 : 0.001);
}

INSTANTIATE_TEST_SUITE_P(Data, RendererAndEmbreeOn,
                         testing::Values("xarm7/xarm7_with_gripper.urdf",
                                         "kuka_lbr_med7/lbr_med7.urdf", "franka_panda/panda.urdf",
                                         "kuka_iiwa_bullet/model.urdf",
                                         "kinova_gen3_2f85/gen3_robotiq_2f_85.urdf", "pr2/pr2.urdf",
                                         "widowx/widowx.urdf", "r2d2/r2d2.urdf"),
                         [](const auto& robot) {
                           return std::filesystem::path(robot.param).begin()->string();
                         });

}  // namespace
}  // namespace berth
