#include "berth/space/voxel_grid.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>

#include "tests/support/plain_distance.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

constexpr double kHalf_m = 1.5;
const Eigen::AlignedBox3d kBox(Eigen::Vector3d::Constant(-kHalf_m),
                               Eigen::Vector3d::Constant(kHalf_m));

/// The voxel that holds a point; none beside the grid.
std::optional<Voxel> voxel_at(const VoxelGrid& grid, const Eigen::Vector3d& p_B) {
  const Eigen::Array3d at = (p_B / grid.edge_m).array().floor();
  const Eigen::Vector3i place = at.cast<int>().matrix() - grid.first;
  if ((place.array() < 0).any() || (place.array() >= grid.count.array()).any()) return {};
  return grid(place.x(), place.y(), place.z());
}

MeshWorld world_of(std::uint32_t seed) {
  MeshWorldSettings settings;
  settings.views = 1 + static_cast<int>(seed % 3);
  // Some voxels are smaller than a pixel, others reach over many.
  if (seed % 2 == 1) settings = {settings.views, 96, 72, 3, 4, 0.002};
  MeshWorld world = draw_mesh_world(settings, 900 + seed);
  if (seed % 3 == 2) world.views[1].age_s = 0.02;
  return world;
}

/// What a point is, told point by point, its voxel reports too, or something worse.
TEST(VoxelGrid, VoxelsTellTheWorstOfTheirPoints) {
  sim::Random random(3);
  int hidden = 0, free = 0, told_free = 0;
  for (std::uint32_t seed = 0; seed < thinned(24u); ++seed) {
    const MeshWorld world = world_of(seed);
    const PreparedWorld prepared(world);
    const PlainSpace plain(world);
    VoxelGrid grid;
    lay_voxels(kBox, seed % 4 < 2 ? 0.03 : 0.1, grid);
    find_voxels(prepared.space().views(), grid);
    for (int i = 0; i < 4000; ++i) {
      const Eigen::Vector3d p_B = sim::draw_point(random, kHalf_m);
      const std::optional<Voxel> voxel = voxel_at(grid, p_B);
      if (!voxel) continue;
      bool is_free = false;
      for (std::size_t k = 0; k < world.views.size(); ++k) is_free |= plain.is_free(k, p_B);
      ASSERT_TRUE(is_free || *voxel != Voxel::free) << "seed " << seed;
      const bool is_hidden = plain.is_hidden(p_B) && !is_free;
      ASSERT_TRUE(!is_hidden || *voxel == Voxel::hidden || *voxel == Voxel::occupied);
      hidden += is_hidden;
      free += is_free;
      told_free += *voxel == Voxel::free;
    }
  }
  EXPECT_GT(hidden, thinned(2000));
  EXPECT_GT(free, thinned(2000));
  // Else it would be of no use.
  EXPECT_GT(told_free, 0.5 * free);
}

TEST(VoxelGrid, ReadingsOccupyTheirVoxelsAndNothingElseIsOccupied) {
  int occupied = 0;
  for (std::uint32_t seed = 0; seed < thinned(12u); ++seed) {
    const MeshWorld world = world_of(seed);
    const PreparedWorld prepared(world);
    VoxelGrid grid;
    lay_voxels(kBox, 0.05, grid);
    find_voxels(prepared.space().views(), grid);
    std::set<std::size_t> expected;
    for (const MeshWorldView& view : world.views) {
      for (int v = 0; v < view.camera.height_px; ++v) {
        for (int u = 0; u < view.camera.width_px; ++u) {
          const double z = view.obstacles.depth_m(u, v);
          if (std::isnan(z)) continue;
          const Eigen::Vector3d p_C(z * (u - view.camera.cx_px) / view.camera.fx_px,
                                    z * (v - view.camera.cy_px) / view.camera.fy_px, z);
          const Eigen::Vector3d p_B = view.X_BC * p_C;
          if (!voxel_at(grid, p_B)) continue;
          const Eigen::Array3d at = (p_B / grid.edge_m).array().floor();
          expected.insert(grid.index(at.cast<int>().matrix() - grid.first));
        }
      }
    }
    std::set<std::size_t> told;
    grid.for_each([&](const Eigen::Vector3i& at, Voxel voxel) {
      if (voxel == Voxel::occupied) told.insert(grid.index(at));
    });
    EXPECT_EQ(told, expected) << "seed " << seed;
    occupied += static_cast<int>(told.size());
  }
  EXPECT_GT(occupied, 100);
}

TEST(VoxelGrid, CornersLieAtWholeMultiplesOfTheEdge) {
  VoxelGrid grid;
  lay_voxels({Eigen::Vector3d(-0.11, 0.01, 0.2), Eigen::Vector3d(0.01, 0.09, 0.26)}, 0.05, grid);
  EXPECT_EQ(grid.first, Eigen::Vector3i(-3, 0, 4));
  EXPECT_EQ(grid.count, Eigen::Vector3i(4, 2, 2));
  EXPECT_TRUE(grid.corner_m().isApprox(Eigen::Vector3d(-0.15, 0, 0.2)));
  EXPECT_TRUE(grid.centre_m({3, 1, 0}).isApprox(Eigen::Vector3d(0.025, 0.075, 0.225)));
  EXPECT_EQ(grid.voxels.size(), 16u);
}

TEST(VoxelGrid, WithoutViewsNothingIsKnown) {
  VoxelGrid grid;
  lay_voxels(kBox, 0.5, grid);
  find_voxels({}, grid);
  for (const Voxel voxel : grid.voxels) EXPECT_EQ(voxel, Voxel::unseen);
}

TEST(VoxelGrid, RefusesBoxesAndEdgesThatAreNone) {
  VoxelGrid grid;
  const auto refuses = [&](const Eigen::AlignedBox3d& box, double edge_m, const std::string& text) {
    try {
      lay_voxels(box, edge_m, grid);
      ADD_FAILURE() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), text);
    }
  };
  refuses(kBox, 0.001, "the edge of a voxel is 0.001000 m; expected at least 0.005000");
  refuses(kBox, std::numeric_limits<double>::quiet_NaN(),
          "the edge of a voxel is nan m; expected at least 0.005000");
  refuses({}, 0.1, "the box of the voxels is empty or not finite; expected metres");
  refuses({Eigen::Vector3d::Zero(), Eigen::Vector3d(1, 0, 1)}, 0.1,
          "the box of the voxels is empty or not finite; expected metres");
  refuses({Eigen::Vector3d::Constant(1e8), Eigen::Vector3d::Constant(1e8 + 1)}, 0.1,
          "the box of the voxels is farther away than 1000000.000000 m; expected one around the "
          "robot");
  refuses({Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(100)}, 0.01,
          "the box has 1000000000000.000000 voxels; expected at most 20000000.000000");
}

}  // namespace
}  // namespace berth::testing
