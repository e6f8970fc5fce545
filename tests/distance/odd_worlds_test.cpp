// Cameras and links that are not as usual.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "berth/robot/primitives.hpp"
#include "tests/support/plain_distance.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

void expect_nothing_near(const WholeLinkDistance& link, float range_m) {
  for (const SpacePair* pair : {&link.nearest, &link.occupied}) {
    EXPECT_FALSE(pair->is_known());
    EXPECT_EQ(pair->lower_bound_m, range_m);
    EXPECT_TRUE(std::isnan(pair->distance_m));
  }
}

TEST(MeshOdd, WithoutACameraNothingIsNear) {
  MeshWorldSettings settings;
  settings.views = 0;
  const MeshWorld world = draw_mesh_world(settings, 1);
  for (const auto& link : PreparedWorld(world).ask({})) expect_nothing_near(link, 1);
}

TEST(MeshOdd, EmptyImages) {
  for (const int views : {1, 2, 3}) {
    MeshWorldSettings settings;
    settings.views = views;
    MeshWorld world = draw_mesh_world(settings, 1);
    for (MeshWorldView& view : world.views) {
      view.camera.width_px = view.camera.height_px = 0;
      view.sensor_depth_m = view.environment_front_m = view.environment_back_m = DepthImage();
      view.obstacles = ObstacleImage();
    }
    for (const auto& link : PreparedWorld(world).ask({})) expect_nothing_near(link, 1);
  }
}

TEST(MeshOdd, ImagesWithoutAReading) {
  for (const int views : {1, 2, 3}) {
    MeshWorldSettings settings;
    settings.views = views;
    settings.dropout = 1;
    const MeshWorld world = draw_mesh_world(settings, 1);
    for (const auto& link : PreparedWorld(world).ask({})) expect_nothing_near(link, 1);
  }
}

TEST(MeshOdd, AllSizes) {
  for (const auto& [width, height] :
       {std::pair{1, 1}, {2, 2}, {3, 3}, {7, 5}, {8, 8}, {9, 1}, {1, 9}, {33, 31}, {65, 40}}) {
    for (std::uint32_t seed = 0; seed < 4; ++seed) {
      SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
      MeshWorldSettings settings;
      settings.views = 1 + static_cast<int>(seed % 2);
      settings.width_px = width;
      settings.height_px = height;
      settings.links = 1;
      const MeshWorld world = draw_mesh_world(settings, 20 + seed);
      const auto found = PreparedWorld(world).ask({});
      const double reading_m = plain_pixel_distance(world, 0, false, 1);
      EXPECT_LE(found[0].occupied.lower_bound_m, reading_m);
      EXPECT_EQ(found[0].occupied.is_known(), reading_m < 1);
      if (found[0].occupied.is_known()) {
        EXPECT_GE(found[0].occupied.distance_m, reading_m - 5e-6);
        EXPECT_LE(found[0].occupied.distance_m, reading_m + 1.01e-3);
      }
    }
  }
}

/// A wall before the camera, at z = 1 m of it.
MeshWorld wall_world(const Pose& X_BC, TriangleMesh link_L, const Pose& X_BL) {
  MeshWorld world;
  Link link;
  link.mesh_L = std::move(link_L);
  link.role = LinkRole::evaluated;
  link.id = 1;
  world.model.links.push_back(link);
  world.model.evaluated_links = {0};
  world.pose.X_BL = {X_BL};
  MeshWorldView view;
  view.camera = {64, 48, 60, 60, 31.5, 23.5};
  view.X_BC = X_BC;
  view.sensor_depth_m = DepthImage(64, 48, 1.0f);
  view.environment_back_m = DepthImage();
  view.obstacles.depth_m = view.sensor_depth_m;
  view.obstacles.fate = Image<PixelFate>(64, 48, PixelFate::obstacle);
  world.views.push_back(view);
  return world;
}

Pose at(double x, double y, double z) { return Pose(Eigen::Translation3d(x, y, z)); }

TEST(MeshOdd, ABoxBeforeAWall) {
  const MeshWorld world = wall_world(Pose::Identity(), make_box({0.2, 0.2, 0.2}), at(0.05, 0, 0.5));
  const WholeLinkDistance link = PreparedWorld(world).ask({1.0, 1e-4})[0];
  EXPECT_NEAR(link.occupied.distance_m, 0.4, 1e-4);
  EXPECT_NEAR(link.nearest.distance_m, 0.4, 1e-4);
  EXPECT_EQ(link.nearest.obstacle_is, ObstacleKind::occupied);
  EXPECT_NEAR(link.occupied.obstacle_point_B_m.z(), 1.0, 1e-5);
}

TEST(MeshOdd, ABoxBehindAWallIsWithinItsShadow) {
  const MeshWorld world = wall_world(Pose::Identity(), make_box({0.2, 0.2, 0.2}), at(0, 0, 1.5));
  const WholeLinkDistance link = PreparedWorld(world).ask({})[0];
  EXPECT_NEAR(link.occupied.distance_m, 0.37, 1.1e-3);
  EXPECT_EQ(link.nearest.distance_m, 0);
  EXPECT_EQ(link.nearest.obstacle_is, ObstacleKind::unknown);
  EXPECT_EQ(link.nearest.robot_point_B_m, link.nearest.obstacle_point_B_m);
}

TEST(MeshOdd, ContactIsZeroWithBothPointsEqual) {
  for (const int views : {1, 2}) {
    MeshWorld world = wall_world(Pose::Identity(), make_box({0.2, 0.2, 0.2}), at(0, 0, 0.95));
    if (views == 2) world.views.push_back(world.views[0]);
    const WholeLinkDistance link = PreparedWorld(world).ask({})[0];
    for (const SpacePair* pair : {&link.nearest, &link.occupied}) {
      EXPECT_EQ(pair->distance_m, 0);
      EXPECT_EQ(pair->lower_bound_m, 0);
      EXPECT_EQ(pair->robot_point_B_m, pair->obstacle_point_B_m);
    }
  }
}

/// Something black hangs before the wall; the known cell is kept in its place.
TEST(MeshOdd, ALinkInWhatAHoleHides) {
  for (const int views : {1, 2}) {
    MeshWorld world = wall_world(Pose::Identity(), make_box({0.1, 0.1, 0.1}), at(0, 0, 0.7));
    MeshWorldView& view = world.views[0];
    for (int v = 8; v < 40; ++v) {
      for (int u = 12; u < 52; ++u) {
        view.sensor_depth_m(u, v) = kNoDepth;
        view.obstacles.fate(u, v) = PixelFate::hole;
        ++view.obstacles.count[static_cast<std::size_t>(PixelFate::hole)];
      }
    }
    if (views == 2) world.views.push_back(world.views[0]);
    const WholeLinkDistance link = PreparedWorld(world).ask({})[0];
    EXPECT_EQ(link.nearest.distance_m, 0) << views;
    EXPECT_EQ(link.nearest.obstacle_is, ObstacleKind::unknown) << views;
    EXPECT_NEAR(link.occupied.distance_m, 0.25, 1.1e-3) << views;
    // The first 3 cm of what is hidden are no surface either.
    world.pose.X_BL = {at(0, 0, -0.1)};
    const WholeLinkDistance before = PreparedWorld(world).ask({})[0];
    EXPECT_GT(before.nearest.distance_m, 0.05) << views;
    EXPECT_LT(before.nearest.distance_m, 0.2) << views;
    EXPECT_EQ(before.nearest.obstacle_is, ObstacleKind::unknown) << views;
  }
}

TEST(MeshOdd, ACameraThatLooksAway) {
  Pose X_BC = Pose::Identity();
  X_BC.linear() = Eigen::AngleAxisd(3.14159265, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const MeshWorld world = wall_world(X_BC, make_box({0.2, 0.2, 0.2}), at(0, 0, 0.5));
  expect_nothing_near(PreparedWorld(world).ask({})[0], 1);
  const WholeLinkDistance link = PreparedWorld(world).ask({2.0})[0];
  EXPECT_NEAR(link.occupied.distance_m, 1.4, 1.1e-3);
}

TEST(MeshOdd, ACameraInsideOfALink) {
  const MeshWorld world = wall_world(Pose::Identity(), make_box({0.4, 0.4, 0.4}), at(0, 0, 0.1));
  const WholeLinkDistance link = PreparedWorld(world).ask({})[0];
  EXPECT_NEAR(link.occupied.distance_m, 0.7, 1.1e-3);
}

TEST(MeshOdd, TwoCamerasThatAreOne) {
  for (std::uint32_t seed = 0; seed < thinned(6u); ++seed) {
    MeshWorldSettings settings;
    settings.views = 1;
    MeshWorld one = draw_mesh_world(settings, 40 + seed);
    MeshWorld two = one;
    two.views.push_back(two.views[0]);
    const auto alone = PreparedWorld(one).ask({});
    const auto both = PreparedWorld(two).ask({});
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_EQ(alone[i].occupied.is_known(), both[i].occupied.is_known());
      if (!alone[i].occupied.is_known()) continue;
      EXPECT_NEAR(alone[i].occupied.distance_m, both[i].occupied.distance_m, 1.1e-3);
      // What a pixel of the robot frees of its neighbour's shadow is all that may go.
      EXPECT_GE(both[i].nearest.distance_m, alone[i].nearest.lower_bound_m);
    }
  }
}

TEST(MeshOdd, ALinkFarAwayIsNearNothing) {
  const MeshWorld world = wall_world(Pose::Identity(), make_box({0.2, 0.2, 0.2}), at(30, 0, 0));
  expect_nothing_near(PreparedWorld(world).ask({})[0], 1);
}

TEST(MeshOdd, BeyondTheCubesNoBoundIsGiven) {
  MeshWorld world = wall_world(Pose::Identity(), make_box({0.2, 0.2, 0.2}), at(300, 0, 0));
  world.views.push_back(world.views[0]);
  const WholeLinkDistance link = PreparedWorld(world).ask({})[0];
  EXPECT_FALSE(link.nearest.is_known());
  EXPECT_EQ(link.nearest.lower_bound_m, 0);
  EXPECT_EQ(link.occupied.lower_bound_m, 1);
}

TEST(MeshOdd, ALinkWithoutTriangles) {
  const MeshWorld world = wall_world(Pose::Identity(), TriangleMesh(), at(0, 0, 0.5));
  expect_nothing_near(PreparedWorld(world).ask({})[0], 1);
}

TEST(MeshOdd, TrianglesThatAreNeedlesOrPoints) {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {0.1f, 0, 0}, {0.05f, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 0, 0}, {1, 1, 0}};
  const MeshWorld world = wall_world(Pose::Identity(), mesh, at(0, 0, 0.5));
  const WholeLinkDistance link = PreparedWorld(world).ask({})[0];
  EXPECT_NEAR(link.occupied.distance_m, 0.5, 1.1e-3);
}

TEST(MeshOdd, BadRequestsAreRefused) {
  const MeshWorld world = wall_world(Pose::Identity(), make_box({0.2, 0.2, 0.2}), at(0.05, 0, 0.5));
  const PreparedWorld prepared(world);
  EXPECT_THROW(prepared.ask({0}), std::invalid_argument);
  EXPECT_THROW(prepared.ask({1, -1}), std::invalid_argument);
  EXPECT_THROW(prepared.ask({1, 0.1, -1.0}), std::invalid_argument);
  EXPECT_THROW(validate(SpaceSettings{.obstacle_speed_m_s = -0.1}), std::invalid_argument);
}

}  // namespace
}  // namespace berth::testing
