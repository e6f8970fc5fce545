// The silhouette of the enlarged robot: what the robot-shaped region of surveillance holds.
#include "berth/robot/surface.hpp"

#include <gtest/gtest.h>

#include "berth/render/robot_renderer.hpp"
#include "tests/render/small_robot.hpp"

namespace berth {
namespace {

const Camera kRegionCamera{160, 120, 130, 130, 78, 61};

RobotImage render(const RobotModel& model, const RobotPose& pose) {
  RobotImage image;
  RobotRenderer(build_link_meshes(model), kRegionCamera).render(pose, Pose::Identity(), image);
  return image;
}

/// Three shapes of random_mesh and their poses; a cloud of triangles is not convex.
struct ShapeScene {
  RobotModel model;
  RobotPose pose;

  explicit ShapeScene(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<TriangleMesh> meshes;
    std::vector<Pose> X_CL;
    while (meshes.size() < 3) {
      TriangleMesh mesh = random_mesh(random);
      if (mesh.vertices_m.size() == 36 && mesh.triangles.size() == 12) continue;
      meshes.push_back(std::move(mesh));
      // Some come near the camera: enlarged, they swallow it.
      X_CL.push_back(random_pose(random, {Eigen::Vector3d(-1, -1, 0.6), Eigen::Vector3d(1, 1, 3)}));
    }
    model = robot_of(std::move(meshes));
    pose = pose_seen_at(Pose::Identity(), X_CL);
  }
};

TEST(RobotRegion, OfScale1IsTheRobot) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const ShapeScene scene(seed);
    const RobotImage region = render(robot_region(scene.model, 1), scene.pose);
    const RobotImage robot = render(scene.model, scene.pose);
    int differ = 0;
    for (std::size_t i = 0; i < robot.link_id.pixels().size(); ++i)
      differ += robot.link_id.pixels()[i] != region.link_id.pixels()[i];
    EXPECT_LE(differ, 2) << seed;
  }
}

TEST(RobotRegion, GrowsWithItsScaleAndHoldsConvexLinks) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const ShapeScene scene(seed);
    RobotImage inner = render(scene.model, scene.pose);
    for (const double scale : {1.2, 2.0, 6.0}) {
      const RobotImage outer = render(robot_region(scene.model, scale), scene.pose);
      for (std::size_t i = 0; i < inner.link_id.pixels().size(); ++i) {
        const bool was_inside = inner.link_id.pixels()[i] != kNoLink;
        const bool is_inside = outer.link_id.pixels()[i] != kNoLink;
        EXPECT_LE(was_inside, is_inside) << "seed " << seed << ", scale " << scale;
      }
      inner = outer;
    }
  }
}

TEST(RobotRegion, LeavesEnvironmentOut) {
  ShapeScene scene(3);
  set_last_role(scene.model, LinkRole::environment);
  const RobotImage region = render(robot_region(scene.model, 2), scene.pose);
  for (const LinkId id : region.link_id.pixels()) EXPECT_TRUE(id <= 2);
}

}  // namespace
}  // namespace berth
