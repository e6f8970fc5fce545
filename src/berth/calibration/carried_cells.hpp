// Inside calibration/ only: what moves along with a link, as cells in its frame.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "berth/calibration/evidence_view.hpp"

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

/// A reading of something that moves.
struct MovingReading {
  std::size_t view = 0;
  Eigen::Vector3d p_B_m = Eigen::Vector3d::Zero();
  /// Else the self filter takes it away already.
  bool is_left = true;
  /// Beside a pixel that shows something else, or nothing: its depth may be of neither.
  bool is_at_edge = false;
  /// By a part that was found.
  bool is_explained = false;
};

std::vector<MovingReading> moving_readings(const std::vector<EvidenceView>& views);

/// Cells of one piece that move with a group of links, in the frame L of RigidGroup::link.
struct CarriedCells {
  RigidGroup group;
  /// Each was seen at two places of the room at least, and never free.
  CellSet cells;
  /// The views that show a fair share of them.
  std::vector<std::size_t> seen_in;
  /// How many places of the room it was seen at that differ.
  int places = 0;
  /// How far apart the two farthest of them are, and how large the piece is.
  double apart_m = 0;
  double size_m = 0;
  /// How many of the readings that nothing explains, and that the self filter leaves, it does.
  int explains = 0;

  bool is_proven() const;
};

/// Fewer places of the room prove no part.
inline constexpr int kLeastRoomPlaces = 3;

/// All pieces of a group.
std::vector<CarriedCells> find_carried_cells(const RigidGroup& group,
                                             const std::vector<EvidenceView>& views,
                                             const std::vector<MovingReading>& readings);

}  // namespace berth
