#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "berth/distance/link_field.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth {

/// Patches of one size of one link. Each holds its triangles in a cylinder, centre c, axis m of
/// length 1, half height h, radius r, and in a box about c of the same height, whose other sides
/// lie along x and m x x. In the link's own frame L, metres; padded with copies of the last one to
/// a multiple of 16.
struct PatchLevel {
  int count = 0;
  std::array<std::vector<float>, 3> centre_m;
  std::array<std::vector<float>, 3> axis;
  std::vector<float> half_height_m;
  std::vector<float> radius_m;
  /// x, y = m x x, and half of the box's sides along them.
  std::array<std::vector<float>, 3> x;
  std::array<std::vector<float>, 3> y;
  std::vector<float> half_x_m;
  std::vector<float> half_y_m;
};

/// One link's surface: patches of 16 triangles that lie side by side, 16 of these in each patch of
/// the next level, and so on up to a single one. Patch i of a level has the children 16 i to
/// 16 i + 15 of the level below, as far as they exist; those of levels[0] are triangles.
struct LinkPatches {
  static constexpr int kChildren = 16;

  /// Of RobotModel::links.
  std::size_t link = 0;
  int triangle_count = 0;
  /// Coordinate k % 3 of corner k / 3 of each triangle, padded as the patches are.
  std::array<std::vector<float>, 9> corners_m;
  std::vector<PatchLevel> levels;
  /// Null without triangles.
  std::unique_ptr<const mesh::LinkField> field;

  bool empty() const { return triangle_count == 0; }
};

/// The surfaces of all evaluated links, each as a tree of patches of triangles in the link's own
/// frame: constant, shared by all askers.
struct RobotPatches {
  /// links[i] is the link with the id i + 1.
  std::vector<LinkPatches> links;
  /// No other robot's.
  std::uint64_t serial_number = 0;
};

/// Of a mesh in its own frame; LinkPatches::link is left to the caller.
LinkPatches build_link_patches(const TriangleMesh& mesh);

std::shared_ptr<const RobotPatches> build_robot_patches(const RobotModel& model);

}  // namespace berth
