// The cubes that space is cut into, in the robot's root frame B.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace berth::mesh {

/// A cube of edge 4^level times 0.1 mm; column, row and layer count from a corner of all space
/// along x, y and z.
struct Cube {
  static constexpr double kLeastEdge_m = 1e-4;
  /// The greatest cubes have 1.6 m, and 64 of them stand side by side.
  static constexpr int kTopLevel = 7;
  static constexpr int kCount = 1 << 20;
  /// Beside the middle, so that no robot stands where eight great cubes meet.
  static constexpr double kCorner_m = -53.1;

  int level = 0;
  int x = 0;
  int y = 0;
  int z = 0;

  double edge_m() const { return kLeastEdge_m * (1 << 2 * level); }
  Eigen::Vector3d corner_m() const {
    return edge_m() * Eigen::Vector3d(x, y, z) + Eigen::Vector3d::Constant(kCorner_m);
  }
  /// Child i of 64 lies at (i % 4, i / 4 % 4, i / 16).
  Cube child(int i) const {
    return {level - 1, 4 * x + (i & 3), 4 * y + (i >> 2 & 3), 4 * z + (i >> 4)};
  }

  /// A number of 63 bits, never 0 for a cube that has children.
  std::uint64_t key() const {
    return static_cast<std::uint64_t>(level) << 60 | static_cast<std::uint64_t>(z) << 40 |
           static_cast<std::uint64_t>(y) << 20 | static_cast<std::uint64_t>(x);
  }
  static Cube of_key(std::uint64_t key) {
    constexpr std::uint64_t kMask = kCount - 1;
    return {static_cast<int>(key >> 60 & 7), static_cast<int>(key & kMask),
            static_cast<int>(key >> 20 & kMask), static_cast<int>(key >> 40 & kMask)};
  }
};

/// The place along one axis of the greatest cube that holds this coordinate; outside of
/// [0, kCount >> 2 kTopLevel) where none does.
inline int top_cube_at(double coordinate_m) {
  const double edge_m = Cube{Cube::kTopLevel, 0, 0, 0}.edge_m();
  return static_cast<int>(std::floor((coordinate_m - Cube::kCorner_m) / edge_m));
}

}  // namespace berth::mesh
