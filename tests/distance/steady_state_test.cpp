// A program of its own, because allocation_count replaces the global operator new.
#include <gtest/gtest.h>

#include <string>

#include "berth/distance/known_distances.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/mesh_world.hpp"

namespace berth::testing {
namespace {

TEST(MeshSteadyState, NothingIsAllocatedOnceTheSceneWasSeen) {
  MeshWorldSettings settings;
  settings.views = 3;
  MeshWorld world = draw_mesh_world(settings, 9);
  world.views[0].age_s = 0.01;
  const auto robot = build_robot_patches(world.model);
  std::vector<CameraSpace> spaces(3);
  std::vector<PosedSpace> posed(3);
  UnknownSpace space;
  MeshWorkspace workspace;
  std::vector<WholeLinkDistance> out;
  const auto frame_and_requests = [&] {
    for (int k = 0; k < 3; ++k) {
      const MeshWorldView& view = world.views[k];
      build_camera_space(view.camera, view.sensor_depth_m, view.obstacles, view.environment(),
                         world.settings, spaces[k]);
      posed[k] = {&spaces[k], view.X_BC, view.age_s};
    }
    space.assign(posed);
    for (const bool hidden : {true, false}) {
      mesh_distances(*robot, world.pose, space, {1.0, 1e-3, std::nullopt, hidden}, workspace, out);
    }
    space.assign(std::span(posed).first(1));
    mesh_distances(*robot, world.pose, space, {}, workspace, out);
  };
  frame_and_requests();
  frame_and_requests();
  const std::size_t before = allocation_count();
  frame_and_requests();
  EXPECT_EQ(allocation_count(), before);
  EXPECT_GT(before, 0u);
}

TEST(KnownSteadyState, NothingIsAllocatedOnceThePosesWereSeen) {
  RobotModel moving = draw_mesh_world({.links = 6}, 9).model;
  for (std::size_t i = 1; i < moving.links.size(); ++i) {
    moving.links[i].parent = i - 1;
    moving.links[i].joint.X_PJ = Pose(Eigen::Translation3d(0.2, 0.1, 0.1));
    moving.links[i].joint.type = JointType::revolute;
    moving.links[i].joint.position_index = moving.joints.size();
    moving.joints.push_back({std::to_string(i), JointType::revolute, -1, 1});
  }
  const auto known = build_known_model(moving, build_robot_patches(moving));
  ASSERT_FALSE(known->pairs.empty());
  RobotPose pose;
  KnownWorkspace workspace;
  std::vector<KnownPair> out;
  std::vector<double> positions(moving.joints.size());
  // Slowly and with jumps.
  const auto go_through = [&] {
    for (int i = 0; i < 400; ++i) {
      for (std::size_t j = 0; j < positions.size(); ++j) {
        positions[j] = i / 100 * 0.3 + 0.001 * i * static_cast<double>(j);
      }
      forward_kinematics(moving, positions, pose);
      known_distances(*known, pose, {}, workspace, out);
    }
  };
  go_through();
  go_through();
  const std::size_t before = allocation_count();
  go_through();
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace berth::testing
