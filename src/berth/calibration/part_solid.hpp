// Inside calibration/ only: from the cells of a surface to the body behind it.
#pragma once

#include "berth/calibration/carried_cells.hpp"

namespace berth {

/// Cells of a box, in the frame L.
struct SolidCells {
  Cell first = Cell::Zero();
  Cell size = Cell::Zero();
  /// Of the box's cells, x fastest.
  std::vector<std::uint8_t> is_solid;

  std::size_t index_of(const Cell& cell) const {
    const Cell in = cell - first;
    return (static_cast<std::size_t>(in.z()) * static_cast<std::size_t>(size.y()) +
            static_cast<std::size_t>(in.y())) *
               static_cast<std::size_t>(size.x()) +
           static_cast<std::size_t>(in.x());
  }
  bool contains(const Cell& cell) const {
    const Cell in = cell - first;
    return (in.array() >= 0).all() && (in.array() < size.array()).all() &&
           is_solid[index_of(cell)] != 0;
  }
  double volume_m3() const;
};

/// The piece with what belongs to it that was seen from one side only: readings of what moves
/// within kGrown_m of it. Surfaces that only hide something are closed by the hull of all these;
/// what was ever seen free is no part of it.
SolidCells solid_of(const CarriedCells& piece, const std::vector<EvidenceView>& views,
                    const std::vector<MovingReading>& readings);

inline constexpr double kGrown_m = 0.03;

}  // namespace berth
