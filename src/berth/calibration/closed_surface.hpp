// Inside calibration/ only: the cells of a body, and a closed mesh around them.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/calibration/carried_cells.hpp"
#include "berth/robot/triangle_mesh.hpp"

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
};

/// How far each cell is from the nearest one that is solid, in cells; negative in the solid, by how
/// far the nearest other cell is. Around the box of `solid` are `margin` cells more on each side; x
/// fastest.
std::vector<float> distance_field(const SolidCells& solid, int margin);

/// A closed mesh in the cells' frame, wound counterclockwise as seen from outside, about
/// `padding_m` outside of all solid cells, of at most kMostSurfaceTriangles triangles or so. At
/// least one cell is solid; the padding is kLeastPadding_m at least, so that thin bodies have two
/// sides.
TriangleMesh closed_surface(const SolidCells& solid, double padding_m);

inline constexpr std::size_t kMostSurfaceTriangles = 800;
inline constexpr double kLeastSurfacePadding_m = 0.005;

}  // namespace berth
