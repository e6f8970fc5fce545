// Inside calibration/ only: a closed mesh around cells.
#pragma once

#include "berth/calibration/solid_cells.hpp"
#include "berth/robot/triangle_mesh.hpp"

namespace berth {

/// A closed mesh in the cells' frame, wound counterclockwise as seen from outside, about
/// `padding_m` outside of all solid cells, of at most kMostSurfaceTriangles triangles or so. At
/// least one cell is solid; the padding is kLeastPadding_m at least, so that thin bodies have two
/// sides.
TriangleMesh closed_surface(const SolidCells& solid, double padding_m);

inline constexpr std::size_t kMostSurfaceTriangles = 800;
inline constexpr double kLeastSurfacePadding_m = 0.005;

}  // namespace berth
