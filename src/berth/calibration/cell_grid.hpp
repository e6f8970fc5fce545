// Inside calibration/ only: space in small cubes.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace berth {

/// The edge of a cell.
inline constexpr double kCell_m = 0.005;

using Cell = Eigen::Vector3i;

inline Cell cell_of(const Eigen::Vector3d& p_m) {
  return (p_m / kCell_m).array().floor().matrix().cast<int>();
}

inline Eigen::Vector3d middle_of(const Cell& cell) {
  return (cell.cast<double>().array() + 0.5).matrix() * kCell_m;
}

/// Cells by where they are; no more than 5 km from the origin.
class CellSet {
 public:
  /// Where a cell stands in cells(), or -1.
  int find(const Cell& cell) const {
    const auto at = places_.find(key(cell));
    return at == places_.end() ? -1 : at->second;
  }
  bool contains(const Cell& cell) const { return find(cell) >= 0; }

  void insert(const Cell& cell) {
    if (places_.emplace(key(cell), static_cast<int>(cells_.size())).second) cells_.push_back(cell);
  }

  /// In the order in which they came.
  const std::vector<Cell>& cells() const { return cells_; }
  std::size_t size() const { return cells_.size(); }

 private:
  static std::uint64_t key(const Cell& cell) {
    const auto part = [](int i) { return static_cast<std::uint64_t>(i + (1 << 20)); };
    return part(cell.x()) << 42 | part(cell.y()) << 21 | part(cell.z());
  }

  std::unordered_map<std::uint64_t, int> places_;
  std::vector<Cell> cells_;
};

/// Calls visit(cell) for each cell that is no more than `reach` cells away along any axis.
template <class Visit>
void each_cell_around(const Cell& cell, int reach, const Visit& visit) {
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) visit(Cell(cell + Cell(x, y, z)));
    }
  }
}

}  // namespace berth
