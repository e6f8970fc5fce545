#include "sim/true_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "berth/robot/primitives.hpp"
#include "sim/embree_renderer.hpp"
#include "sim/seen_surface.hpp"

namespace berth::sim {
namespace {

/// A robot of one cube with sides of 0.4 m, 2 m before a camera that stands at its root and looks
/// along its own z; R and I by rays.
struct CubeScene {
  RobotModel model;
  DrawnScene scene;

  CubeScene() {
    Link link;
    link.name = "cube";
    link.role = LinkRole::evaluated;
    link.id = 1;
    link.mesh_L = make_box({0.4, 0.4, 0.4});
    model.links.push_back(link);
    model.evaluated_links = {0};
    scene.camera = {160, 120, 150, 150, 79.5, 59.5};
    scene.X_BC = Pose::Identity();
    scene.pose.X_BL = {Pose(Eigen::Translation3d(0, 0, 2))};
    scene.robot.depth_m = DepthImage(160, 120, kNoDepth);
    scene.robot.link_id = Image<LinkId>(160, 120, kNoLink);
    const EmbreeRenderer rays = this->rays();
    for (int v = 0; v < 120; ++v) {
      for (int u = 0; u < 160; ++u) {
        const RayHit hit = rays.hit(u, v);
        if (hit.id == kNoLink) continue;
        scene.robot.link_id(u, v) = hit.id;
        scene.robot.depth_m(u, v) = static_cast<float>(hit.depth_m);
      }
    }
    scene.obstacle_depth_m = DepthImage(160, 120, kNoDepth);
  }

  EmbreeRenderer rays() const { return {model, scene.pose, scene.X_BC, scene.camera}; }

  TrueDistance truth_with_ball_at(const Eigen::Vector3d& p_m) {
    scene.obstacles = {{make_box({0.02, 0.02, 0.02}), Pose(Eigen::Translation3d(p_m))}};
    return true_distances(model, build_link_trees(model), scene).front();
  }
};

TEST(SeenSurface, OfACubeIsItsFrontFace) {
  const CubeScene cube;
  const auto seen_C = seen_surfaces_C(cube.model, cube.scene.pose, cube.scene.X_BC,
                                      cube.scene.camera, cube.rays(), cube.scene.robot);
  ASSERT_EQ(seen_C.size(), 1U);
  const Eigen::AlignedBox3f box = seen_C[0].bounding_box_m();
  const double pixel_m = 1.8 / 150;
  EXPECT_NEAR(box.min().z(), 1.8, 1e-6);
  EXPECT_NEAR(box.max().z(), 1.8, 1e-6);
  EXPECT_NEAR(box.max().x(), 0.2, pixel_m);
  EXPECT_LE(box.max().x(), 0.2 + 1e-6);
  double area_m2 = 0;
  for (const auto& [a, b, c] : seen_C[0].triangles) {
    const auto& p = seen_C[0].vertices_m;
    area_m2 += (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
  }
  EXPECT_NEAR(area_m2, 0.16, 4 * 0.4 * pixel_m);
}

TEST(TrueDistances, TellTheSeenSideFromTheWholeLink) {
  CubeScene cube;
  const double pixel_m = 1.8 / 150;
  // 0.3 m before the front face.
  const TrueDistance before = cube.truth_with_ball_at({0, 0, 1.49});
  EXPECT_NEAR(before.whole_m, 0.3, 1e-6);
  EXPECT_NEAR(before.seen_C.distance_m, 0.3, 1e-6);
  EXPECT_NEAR(before.seen_C.a_m.z(), 1.8, 1e-6);
  EXPECT_NEAR(before.seen_C.b_m.z(), 1.5, 1e-6);
  // 0.1 m beside the middle of a side that the camera does not see.
  const TrueDistance beside = cube.truth_with_ball_at({0.31, 0, 2});
  EXPECT_NEAR(beside.whole_m, 0.1, 1e-6);
  EXPECT_NEAR(beside.seen_C.distance_m, std::hypot(0.1, 0.19), pixel_m);
  EXPECT_GT(beside.seen_C.distance_m, std::hypot(0.1, 0.19) - 1e-6);
}

TEST(TrueDistances, TellWhoCouldSeeTheObstaclesPoint) {
  const Camera camera{160, 120, 150, 150, 79.5, 59.5};
  DepthImage depth_m(160, 120, kNoDepth);
  depth_m(100, 60) = 1.5F;
  const auto at = [&](double u, double v, double z_m) {
    return Eigen::Vector3d((u - 79.5) / 150 * z_m, (v - 59.5) / 150 * z_m, z_m);
  };
  EXPECT_EQ(sight_of(at(100, 60, 1.5), camera, depth_m), ObstacleSight::covered);
  EXPECT_EQ(sight_of(at(100, 60, 2.5), camera, depth_m), ObstacleSight::covered);
  EXPECT_EQ(sight_of(at(101.2, 60, 1.6), camera, depth_m), ObstacleSight::covered);
  EXPECT_EQ(sight_of(at(100, 60, 1.4), camera, depth_m), ObstacleSight::behind_robot);
  EXPECT_EQ(sight_of(at(50, 60, 1.5), camera, depth_m), ObstacleSight::behind_robot);
  EXPECT_EQ(sight_of(at(170, 60, 1.5), camera, depth_m), ObstacleSight::outside);
  EXPECT_EQ(sight_of(at(100, 60, -1.5), camera, depth_m), ObstacleSight::outside);
}

TEST(TrueDistances, AreInfiniteForALinkThatIsNotSeen) {
  CubeScene cube;
  std::fill(cube.scene.robot.link_id.pixels().begin(), cube.scene.robot.link_id.pixels().end(),
            kNoLink);
  EXPECT_TRUE(std::isinf(cube.truth_with_ball_at({0, 0, 1.49}).seen_C.distance_m));
}

}  // namespace
}  // namespace berth::sim
