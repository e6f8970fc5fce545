// Shares of a link's surface that can be told without a program.
#include <gtest/gtest.h>

#include "berth/robot/primitives.hpp"
#include "tests/image_distance/visibility/small_world.hpp"

namespace berth {
namespace {

/// Two standard errors of 400 points.
constexpr float kSurfaceError = 0.05F;

float sum(const SightShares& shares) {
  return shares.seen + shares.hidden_by_obstacles + shares.hidden_by_robot + shares.no_reading +
         shares.outside_image;
}

TEST(Surface, SphereIsSeenForJustUnderHalf) {
  for (const double distance_m : {0.5, 1.0, 2.0}) {
    SmallWorld world({make_sphere(0.15)}, {at(0, 0, distance_m)});
    const SightShares shares = world.surface_of_first();
    // The cap whose edge the camera's rays touch.
    const double cap = (1 - 0.15 / distance_m) / 2;
    EXPECT_NEAR(shares.seen, cap, kSurfaceError) << distance_m;
    EXPECT_NEAR(shares.hidden_by_robot, 1 - cap, kSurfaceError) << distance_m;
    EXPECT_EQ(shares.hidden_by_obstacles + shares.outside_image, 0);
  }
}

TEST(Surface, OfABoxThatFacesTheCameraTheFrontIsSeen) {
  SmallWorld world({make_box({0.4, 0.2, 0.3})}, {at(0, 0, 1.5)});
  const double whole_m2 = 2 * (0.4 * 0.2 + 0.4 * 0.3 + 0.2 * 0.3);
  EXPECT_NEAR(world.surface_of_first().seen, 0.4 * 0.2 / whole_m2, 0.02);
}

TEST(Surface, LinkBesideTheImageOrBehindTheCameraIsOutside) {
  for (const Pose& X_CL : {at(3, 0, 1), at(0, -3, 1), at(0, 0, -1), at(0.1, 0, -0.4)}) {
    SmallWorld world({make_sphere(0.15)}, {X_CL});
    EXPECT_EQ(world.surface_of_first().outside_image, 1) << X_CL.translation().transpose();
  }
}

TEST(Surface, LinkAcrossTheImagesEdgeIsOutsideByHalf) {
  // The edge is at x = 160 / 300 z.
  SmallWorld world({make_box({0.2, 0.2, 0.001})}, {at(160.0 / 300, 0, 1)});
  EXPECT_NEAR(world.surface_of_first().outside_image, 0.5, 0.02);
}

TEST(Surface, GrowingPlateHidesEverMoreAndShowsAsMuchLess) {
  SmallWorld world({make_sphere(0.3)}, {at(0, 0, 1.5)});
  const float seen_alone = world.surface_of_first().seen;
  float hidden_before = 0;
  for (int u_end = 90; u_end <= 240; u_end += 10) {
    world.put({0, 0, u_end, 240}, 0.8F);
    const SightShares shares = world.surface_of_first();
    EXPECT_GE(shares.hidden_by_obstacles, hidden_before) << u_end;
    EXPECT_NEAR(shares.hidden_by_obstacles + shares.seen, seen_alone, 1e-6) << u_end;
    hidden_before = shares.hidden_by_obstacles;
  }
  EXPECT_NEAR(hidden_before, seen_alone, 1e-6);
}

TEST(Surface, WallBehindHidesNothing) {
  SmallWorld world({make_sphere(0.3)}, {at(0, 0, 1.5)});
  EXPECT_EQ(world.surface_of_first().hidden_by_obstacles, 0);
}

TEST(Surface, LinkInFrontHidesAll) {
  SmallWorld world({make_sphere(0.15), make_box({0.6, 0.6, 0.02})}, {at(0, 0, 1.5), at(0, 0, 1)});
  EXPECT_EQ(world.surface_of_first().hidden_by_robot, 1);
}

TEST(Surface, EnvironmentInFrontHidesAsALinkDoes) {
  RobotModel model = robot_of({make_sphere(0.15), make_box({0.6, 0.6, 0.02})});
  set_last_role(model, LinkRole::environment);
  SmallWorld world(std::move(model), {at(0, 0, 1.5), at(0, 0, 1)}, kPlainCamera);
  EXPECT_EQ(world.surface_of_first().hidden_by_robot, 1);
}

TEST(Surface, WithoutReadingsNothingIsSeen) {
  SmallWorld world({make_sphere(0.3)}, {at(0, 0, 1.5)});
  const float seen = world.surface_of_first().seen;
  world.put(kEverywhere, kNoDepth);
  const SightShares shares = world.surface_of_first();
  EXPECT_EQ(shares.seen, 0);
  EXPECT_NEAR(shares.no_reading, seen, kSurfaceError);
}

TEST(Surface, LinkBetweenTwoColumnsOfPixelsIsNotSeen) {
  // 0.1 px wide, between the columns 159 and 160.
  SmallWorld world({make_box({0.0003, 0.3, 0.0003})}, {at(0, 0, 1)});
  EXPECT_EQ(world.surface_of_first().seen, 0);
}

TEST(Surface, TrianglesWithoutAreaHaveNoShares) {
  TriangleMesh line;
  line.vertices_m = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.triangles = {{0, 1, 2}};
  SmallWorld world({line}, {at(0, 0, 1.5)});
  EXPECT_FALSE(world.surface_of_first().is_known());
}

TEST(Surface, WhereTheRobotMovesToIsSeenUnlessItStoodInFront) {
  SmallWorld world({make_sphere(0.15)}, {at(0, 0, 1.5)});
  const float seen = world.surface_of_first().seen;
  world.move_asked({at(0.5, 0, 1.5)});
  EXPECT_NEAR(world.surface_of_first().seen, seen, kSurfaceError);
  world.move_asked({at(0, 0, 2.5)});
  EXPECT_EQ(world.surface_of_first().seen, 0);
  EXPECT_EQ(world.surface_of_first().hidden_by_robot, 1);
}

TEST(Surface, SharesAddUpToOneForOddCamerasAndRandomShapes) {
  const Camera cameras[] = {{1, 1, 3, 3, 0, 0},
                            {7, 200, 30, 400, 3, 99.5},
                            {160, 120, 90, 140, -200, 60},
                            {160, 120, 2000, 2000, 79.5, 59.5},
                            {160, 120, 20, 20, 79.5, 59.5}};
  std::mt19937 random(3);
  const Eigen::AlignedBox3d positions(Eigen::Vector3d(-0.5, -0.5, -0.2),
                                      Eigen::Vector3d(0.5, 0.5, 2));
  for (const Camera& camera : cameras) {
    for (int i = 0; i < 10; ++i) {
      std::vector<TriangleMesh> meshes;
      std::vector<Pose> X_CL;
      for (int link = 0; link < 4; ++link) {
        meshes.push_back(random_mesh(random));
        X_CL.push_back(random_pose(random, positions));
      }
      SmallWorld world(meshes, X_CL, camera);
      LinkDistance answer;
      answer.status = LinkStatus::ok;
      answer.distance_m = 0.3F;
      answer.robot_point_C_m = {0.1F, 0.1F, 0.5F};
      for (const LinkVisibility& link : world.find(answer)) {
        EXPECT_NEAR(sum(link.surface), 1, 1e-5);
        EXPECT_NEAR(sum(link.space), 1, 1e-5);
        EXPECT_NEAR(link.space_unknown,
                    link.space.hidden_by_robot + link.space.no_reading + link.space.outside_image,
                    1e-5);
      }
    }
  }
}

}  // namespace
}  // namespace berth
