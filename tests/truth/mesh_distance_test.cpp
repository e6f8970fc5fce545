#include "sim/mesh_distance.hpp"

#include <gtest/gtest.h>

#include "berth/robot/primitives.hpp"
#include "sim/drawn_obstacles.hpp"

namespace berth::sim {
namespace {

Pose at(const Eigen::Vector3d& p_m, const Eigen::Quaterniond& rotation) {
  return Eigen::Translation3d(p_m) * Pose(rotation);
}

TEST(MeshDistance, OfTwoTurnedCubesIsThatOfTheirFacingFaces) {
  const MeshTree cube = build_mesh_tree(make_box({1, 1, 1}));
  Random random(1);
  const Pose X_WA = at({3, -2, 1}, draw_rotation(random));
  // B has A's orientation and stands 1.25 m in front of A's face, a little to the side.
  const Pose X_WB = X_WA * Eigen::Translation3d(2.25, 0.2, -0.1);
  const SurfacePair pair = closest_points(cube, X_WA, cube, X_WB);
  EXPECT_NEAR(pair.distance_m, 1.25, 1e-9);
  EXPECT_NEAR((pair.a_m - pair.b_m).norm(), 1.25, 1e-9);
  EXPECT_NEAR((X_WA.inverse() * pair.a_m).x(), 0.5, 1e-9);
  EXPECT_NEAR((X_WB.inverse() * pair.b_m).x(), -0.5, 1e-9);
}

TEST(MeshDistance, IsZeroWhereSurfacesMeet) {
  const MeshTree cube = build_mesh_tree(make_box({1, 1, 1}));
  const Pose X_WB(Eigen::Translation3d(0.9, 0.3, 0.2));
  EXPECT_EQ(closest_points(cube, Pose::Identity(), cube, X_WB).distance_m, 0);
}

TEST(MeshDistance, IsInfiniteBeyondWhatIsAskedForAndWithoutASurface) {
  const MeshTree cube = build_mesh_tree(make_box({1, 1, 1}));
  const Pose X_WB(Eigen::Translation3d(3, 0, 0));
  EXPECT_NEAR(closest_points(cube, Pose::Identity(), cube, X_WB, 2.1).distance_m, 2, 1e-9);
  EXPECT_TRUE(std::isinf(closest_points(cube, Pose::Identity(), cube, X_WB, 1.9).distance_m));
  EXPECT_TRUE(std::isinf(closest_points(cube, Pose::Identity(), nullptr, X_WB).distance_m));
  EXPECT_EQ(build_mesh_tree({}), nullptr);
}

}  // namespace
}  // namespace berth::sim
