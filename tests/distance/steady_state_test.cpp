// A program of its own, because allocation_count replaces the global operator new.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace berth::testing
