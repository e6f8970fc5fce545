#include "berth/space/unknown_space.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

#include "tests/support/plain_distance.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

using mesh::Cube;

/// The cube of this level that holds a point.
Cube cube_at(const Eigen::Vector3d& p_B, int level) {
  Cube cube{level, 0, 0, 0};
  const Eigen::Vector3d place = (p_B.array() - Cube::kCorner_m) / cube.edge_m();
  return {level, static_cast<int>(place.x()), static_cast<int>(place.y()),
          static_cast<int>(place.z())};
}

/// A point that is hidden lies in no cube that holds nothing.
TEST(UnknownSpace, CubesHoldWhatTheirPointsAre) {
  sim::Random random(7);
  int hidden = 0, empty = 0;
  for (std::uint32_t seed = 0; seed < thinned(12u); ++seed) {
    MeshWorldSettings settings;
    settings.views = 2 + static_cast<int>(seed % 3);
    MeshWorld world = draw_mesh_world(settings, 500 + seed);
    if (seed % 3 == 2) world.views[1].age_s = 0.02;
    const PreparedWorld prepared(world);
    const PlainSpace space(world);
    for (int i = 0; i < 4000; ++i) {
      const Eigen::Vector3d p_B = sim::draw_point(random, 1.8);
      const bool is_hidden = space.is_hidden(p_B);
      hidden += is_hidden;
      ASSERT_EQ(prepared.space().hiding_pixel(p_B).has_value(), is_hidden);
      const int level = random.whole(1, Cube::kTopLevel);
      const Cube cube = cube_at(p_B, level);
      const Cube child = cube_at(p_B, level - 1);
      const int place = child.x % 4 + child.y % 4 * 4 + child.z % 4 * 16;
      const bool is_possible = prepared.space().block(cube) >> place & 1;
      ASSERT_TRUE(is_possible || !is_hidden) << "level " << level;
      empty += !is_possible;
    }
  }
  EXPECT_GT(hidden, thinned(1000));
  EXPECT_GT(empty, thinned(1000));
}

/// Pixels up to column 19 hide from 1 m to the environment at 1.5 m; those from 20 on hide nothing,
/// and have no environment. A cube on their border that were in doubt behind 1.5 m would be so with
/// all of its children, down to the smallest ones.
TEST(UnknownSpace, CubesOnTheBorderOfAPixelThatHidesAreEmptyBehindTheEnvironment) {
  const Camera camera{40, 30, 60, 60, 19, 14.5};
  DepthImage depth_m(40, 30, kNoDepth), front_m(40, 30, kNoDepth);
  ObstacleImage obstacles;
  obstacles.fate = Image<PixelFate>(40, 30, PixelFate::no_reading);
  for (int v = 0; v < 30; ++v) {
    for (int u = 0; u <= 20; ++u) front_m(u, v) = 1.5f;
    for (int u = 0; u <= 19; ++u) depth_m(u, v) = 1;
    for (int u = 0; u <= 19; ++u) obstacles.fate(u, v) = PixelFate::obstacle;
  }
  obstacles.depth_m = depth_m;
  CameraSpace seen;
  build_camera_space(camera, depth_m, obstacles, {front_m, front_m}, {}, seen);
  const PosedSpace posed{&seen, Pose::Identity(), 0};
  UnknownSpace space;
  space.assign({&posed, 1});
  const auto may_be_unknown = [&](double z_m) {
    const Cube child = cube_at({z_m * 0.5 / 60, 0, z_m}, 0);
    const Cube cube{1, child.x / 4, child.y / 4, child.z / 4};
    return (space.block(cube) >> (child.x % 4 + child.y % 4 * 4 + child.z % 4 * 16) & 1) != 0;
  };
  for (const double z_m : {1.1, 1.3, 1.49}) EXPECT_TRUE(may_be_unknown(z_m)) << z_m;
  for (const double z_m : {0.9, 1.51, 1.7, 2.5}) EXPECT_FALSE(may_be_unknown(z_m)) << z_m;
}

TEST(UnknownSpace, BlocksAreKeptUntilTheNextViews) {
  MeshWorldSettings settings;
  const MeshWorld world = draw_mesh_world(settings, 1);
  const PreparedWorld prepared(world);
  EXPECT_EQ(prepared.space().kept_blocks(), 0u);
  const Cube cube = cube_at({0.1, 0.2, 0.3}, 4);
  const std::uint64_t first = prepared.space().block(cube);
  EXPECT_EQ(prepared.space().kept_blocks(), 1u);
  const std::uint64_t again = prepared.space().block(cube);
  EXPECT_EQ(prepared.space().kept_blocks(), 1u);
  EXPECT_EQ(first, again);
}

/// More blocks than are kept are found anew each time, to the same answer.
TEST(UnknownSpace, ItsMemoryIsBounded) {
  MeshWorldSettings settings;
  settings.width_px = 8;
  settings.height_px = 6;
  const MeshWorld world = draw_mesh_world(settings, 2);
  const PreparedWorld prepared(world);
  const PreparedWorld other(world);
  for (int i = 0; i < 60000; ++i) {
    const Cube cube{1, 120000 + i % 250, 120000 + i / 250, 132750};
    prepared.space().block(cube);
  }
  EXPECT_LE(prepared.space().kept_blocks(), 1u << 15);
  for (int i = 59900; i < 60000; ++i) {
    const Cube cube{1, 120000 + i % 250, 120000 + i / 250, 132750};
    EXPECT_EQ(prepared.space().block(cube), other.space().block(cube));
  }
}

TEST(UnknownSpace, ManyThreadsMayAsk) {
  MeshWorldSettings settings;
  settings.views = 3;
  const MeshWorld world = draw_mesh_world(settings, 3);
  const PreparedWorld prepared(world);
  const PreparedWorld alone(world);
  const auto ask = [&](std::uint32_t seed, int* wrong) {
    sim::Random random(seed);
    for (int i = 0; i < 3000; ++i) {
      const Cube cube = cube_at(sim::draw_point(random, 0.5), 5);
      *wrong += prepared.space().block(cube) != alone.space().block(cube);
    }
  };
  int wrong[4] = {};
  std::vector<std::thread> threads;
  for (std::uint32_t i = 0; i < 4; ++i) threads.emplace_back(ask, i, &wrong[i]);
  for (auto& thread : threads) thread.join();
  for (const int count : wrong) EXPECT_EQ(count, 0);
}

TEST(UnknownSpace, BadViewsAreRefused) {
  CameraSpace space;
  UnknownSpace hidden;
  const std::vector<PosedSpace> many(UnknownSpace::kMostViews + 1, PosedSpace{&space});
  EXPECT_THROW(hidden.assign(many), std::invalid_argument);
  const PosedSpace from_the_future[] = {{&space, Pose::Identity(), -1}};
  EXPECT_THROW(hidden.assign(from_the_future), std::invalid_argument);
  const PosedSpace nowhere[] = {{&space, unset_pose(), 0}};
  EXPECT_THROW(hidden.assign(nowhere), std::invalid_argument);
}

}  // namespace
}  // namespace berth::testing
