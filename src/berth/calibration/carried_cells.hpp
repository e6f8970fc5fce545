// Inside calibration/ only: what moves along with a link, as cells in its frame.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "berth/calibration/cell_grid.hpp"
#include "berth/calibration/evidence_view.hpp"

namespace berth {

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
