#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace berth {

struct FreeingCamera;

/// What the cameras tell of a cube of space.
enum class Voxel : std::uint8_t {
  unseen,    ///< no camera sees all of it free, and nothing that was seen hides any of it
  hidden,    ///< some of it lies behind a surface that was seen, and no camera sees all of it free
  free,      ///< one camera sees all of it free
  occupied,  ///< a reading lies in it
};

/// Voxels side by side in a box, in the root link's frame B. Their corners lie at whole multiples
/// of the edge, so that two grids with the same edge fit.
struct VoxelGrid {
  /// Edges from 5 mm on, and no more voxels than these.
  static constexpr double kLeastEdge_m = 0.005;
  static constexpr double kMostVoxels = 2e7;

  double edge_m = 0;
  /// The corner of the first voxel, in edges, and how many there are along x, y and z.
  Eigen::Vector3i first = Eigen::Vector3i::Zero();
  Eigen::Vector3i count = Eigen::Vector3i::Zero();
  /// x runs fastest, then y, then z.
  std::vector<Voxel> voxels;

  Eigen::Vector3d corner_m() const { return edge_m * first.cast<double>(); }
  Eigen::Vector3d centre_m(const Eigen::Vector3i& at) const {
    return edge_m * ((first + at).cast<double>().array() + 0.5);
  }
  std::size_t index(const Eigen::Vector3i& at) const {
    return (static_cast<std::size_t>(at.z()) * count.y() + at.y()) * count.x() + at.x();
  }
  Voxel operator()(int x, int y, int z) const { return voxels[index({x, y, z})]; }
  /// Calls visit(place, voxel) for all, in their order.
  template <class Visit>
  void for_each(Visit&& visit) const {
    std::size_t i = 0;
    for (int z = 0; z < count.z(); ++z) {
      for (int y = 0; y < count.y(); ++y) {
        for (int x = 0; x < count.x(); ++x, ++i) visit(Eigen::Vector3i(x, y, z), voxels[i]);
      }
    }
  }
};

/// Lays the voxels that meet the box, all unseen; reuses the grid's memory. Throws
/// std::invalid_argument for an empty box, an edge below kLeastEdge_m or more than kMostVoxels.
void lay_voxels(const Eigen::AlignedBox3d& box_B_m, double edge_m, VoxelGrid& grid);

/// Tells of each voxel what these views do (D2 to D5 of ARCHITECTURE.md). Whole voxels are
/// judged, not their middles: what is free has no point that is not, and what may be hidden in part
/// is hidden. Beside what is free and what is occupied there can be a layer of neither.
void find_voxels(std::span<const FreeingCamera> views, VoxelGrid& grid);

}  // namespace berth
