// How far points are from a link at least, by its field.
//
// For any set M, dist(q, M)^2 - |q|^2 is concave (cube_corners-inl.hpp), also between the points of
// a grid that moves with the link.
#if defined(BERTH_MESH_FIELD_BOUND_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_MESH_FIELD_BOUND_INL_HPP
#undef BERTH_MESH_FIELD_BOUND_INL_HPP
#else
#define BERTH_MESH_FIELD_BOUND_INL_HPP
#endif

#include <array>
#include <limits>

#include "berth/distance/cube_corners-inl.hpp"
#include "berth/distance/link_field.hpp"
#include "berth/distance/nearest_point-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

/// The squares of a cell's corners; those that nobody has asked for yet are found from the mesh.
HWY_INLINE CubeCorners cell_corners(const FieldGrid& grid, const NearestPointSearch& mesh,
                                    const std::array<int, 3>& cell, int hint) {
  CubeCorners corners;
  NearPoints unknown;
  int place[8];
  for (int i = 0; i < 8; ++i) {
    corners.squared_m2[i] = grid.squared_m2(grid.corner(cell, i));
    if (corners.squared_m2[i] > 0) continue;
    place[unknown.count] = i;
    unknown.p_L_m[unknown.count++] = grid.corner_L_m(cell, i);
  }
  if (unknown.count == 0) return corners;
  mesh.find(hint, 0, unknown);
  for (int k = 0; k < unknown.count; ++k) {
    const float lower_m = unknown.distance[k].lower_m;
    // Above 0, since it is known; that is as good as 0.
    const float squared_m2 = std::max(lower_m * lower_m, std::numeric_limits<float>::min());
    corners.squared_m2[place[k]] = squared_m2;
    grid.keep(grid.corner(cell, place[k]), squared_m2);
  }
  return corners;
}

/// No more than the square of the distance of a point; 0 beyond the grid.
HWY_INLINE float field_bound_m2(const FieldGrid& grid, const NearestPointSearch& mesh,
                                const Eigen::Vector3f& p_L_m, int hint) {
  std::array<int, 3> cell;
  Eigen::Vector3f at;
  if (!grid.cell_of(p_L_m, cell, at)) return 0;
  const CubeCorners corners = cell_corners(grid, mesh, cell, hint);
  return corners_within(corners, grid.edge_m(), {at.x(), at.y(), at.z()}, 0).squared_m2[0];
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#endif
