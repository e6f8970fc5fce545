// What a ClearanceField says of one place, in plain code.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "berth/space/clearance_field.hpp"

namespace berth::testing {

inline Eigen::Array3i cell_of(const ClearanceField::Grid& grid, const Eigen::Vector3d& p_B_m) {
  const Eigen::Vector3d low_B_m = grid.low_B_m.cast<double>();
  return ((p_B_m - low_B_m) / ClearanceField::kCell_m).array().floor().cast<int>();
}

inline int place_of(const ClearanceField::Grid& grid, const Eigen::Array3i& cell) {
  return (cell.z() * grid.count[1] + cell.y()) * grid.count[0] + cell.x();
}

inline bool has(const ClearanceField::Grid& grid, const Eigen::Array3i& cell) {
  return (cell >= 0).all() && cell.x() < grid.count[0] && cell.y() < grid.count[1] &&
         cell.z() < grid.count[2];
}

/// The point that a cell knows; it has to have one.
inline Eigen::Vector3d point_of(const ClearanceField::Grid& grid, const Eigen::Array3i& cell) {
  const std::uint32_t point = grid.point[place_of(grid, cell)];
  const Eigen::Vector3d steps(point & 1023, point >> 10 & 1023, point >> 20 & 1023);
  return grid.low_B_m.cast<double>() + ClearanceField::kCell_m * cell.cast<double>().matrix() +
         1e-4 * (steps.array() + 0.5).matrix();
}

/// Nothing is nearer to the place.
inline double lower_bound_m(const ClearanceField::Grid& grid, const Eigen::Vector3d& p_B_m) {
  const Eigen::Array3i cell = cell_of(grid, p_B_m);
  if (!has(grid, cell) || !has(grid, cell + 1)) return 0;
  const Eigen::Array3d t =
      (p_B_m - grid.low_B_m.cast<double>()).array() / ClearanceField::kCell_m - cell.cast<double>();
  double squared = -16 * (t * (1 - t)).sum();
  for (int i = 0; i < 8; ++i) {
    const Eigen::Array3i odd(i & 1, i >> 1 & 1, i >> 2);
    squared += (odd == 1).select(t, 1 - t).prod() * grid.squared[place_of(grid, cell + odd)];
  }
  return ClearanceField::kBox_m * std::sqrt(std::max(0.0, squared));
}

/// The nearest point that any cell within 15 cm knows: something certainly is no farther away.
inline double upper_bound_m(const ClearanceField::Grid& grid, const Eigen::Vector3d& p_B_m) {
  constexpr int kBeside = 6;
  double least_m = std::numeric_limits<double>::infinity();
  const Eigen::Array3i middle = cell_of(grid, p_B_m);
  for (int z = -kBeside; z <= kBeside; ++z) {
    for (int y = -kBeside; y <= kBeside; ++y) {
      for (int x = -kBeside; x <= kBeside; ++x) {
        const Eigen::Array3i cell = middle + Eigen::Array3i(x, y, z);
        if (!has(grid, cell)) continue;
        if (grid.point[place_of(grid, cell)] == ClearanceField::kNoPoint) continue;
        least_m = std::min(least_m, (point_of(grid, cell) - p_B_m).norm());
      }
    }
  }
  return least_m;
}

}  // namespace berth::testing
