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
#include <atomic>
#include <cstdint>
#include <limits>

#include "berth/distance/cube_corners-inl.hpp"
#include "berth/distance/leaf-inl.hpp"
#include "berth/distance/link_field.hpp"
#include "berth/distance/nearest_point-inl.hpp"
#include "berth/distance/patches-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

using IntTag = hn::RebindToSigned<FloatTag>;
using Ints = hn::Vec<IntTag>;

/// Finds from the mesh what nobody has asked for yet of the cell that holds a point; `hint` is a
/// leaf that may be near. Returns whether there was anything to find.
inline bool know_cell(const FieldGrid& grid, const LinkPatches& link, const Eigen::Vector3f& p_L_m,
                      int hint) {
  std::array<int, 3> cell;
  Eigen::Vector3f at;
  if (!grid.cell_of(p_L_m, cell, at)) return false;
  NearPoints unknown;
  int place[8];
  for (int i = 0; i < 8; ++i) {
    if (grid.squared_m2(grid.corner(cell, i)) > 0) continue;
    place[unknown.count] = i;
    unknown.p_L_m[unknown.count++] = grid.corner_L_m(cell, i);
  }
  if (unknown.count == 0) return false;
  // The grid's own roundings: the caller's would depend on where the link is.
  NearestPointSearch(link, rounding_m(grid.reach_m())).find(hint, 0, unknown);
  for (int k = 0; k < unknown.count; ++k) {
    const float lower_m = unknown.distance[k].lower_m;
    // Above 0, since it is known; that is as good as 0.
    const float squared_m2 = std::max(lower_m * lower_m, std::numeric_limits<float>::min());
    grid.keep(grid.corner(cell, place[k]), squared_m2);
  }
  return true;
}

/// Those of the grid's points. One by one, since others may keep them meanwhile.
HWY_INLINE Lanes squares_m2(const FieldPoints& field, Ints place) {
  alignas(64) std::int32_t at[kLanes];
  alignas(64) float squared_m2[kLanes];
  hn::StoreU(place, IntTag(), at);
  for (int i = 0; i < kLanes; ++i) {
    squared_m2[i] = std::atomic_ref(field.squared_m2[at[i]]).load(std::memory_order_relaxed);
  }
  return load(squared_m2);
}

/// No more than the squares of the points' distances by the link's field; 0 where it does not tell.
HWY_INLINE Lanes field_bounds_m2(const FieldPoints& field, const Vectors& p_L_m) {
  const IntTag ints;
  const Lanes zero(0.0f), one(1.0f), per_edge(1 / field.edge_m);
  const Lanes at[3] = {(p_L_m.x - Lanes(field.low_L_m.x())) * per_edge,
                       (p_L_m.y - Lanes(field.low_L_m.y())) * per_edge,
                       (p_L_m.z - Lanes(field.low_L_m.z())) * per_edge};
  LaneMask is_in = one >= zero;
  Ints cell[3] = {hn::Zero(ints), hn::Zero(ints), hn::Zero(ints)};
  Lanes t[3] = {zero, zero, zero};
  for (int k = 0; k < 3; ++k) {
    const Lanes last(static_cast<float>(field.count[k] - 1));
    is_in = both(is_in, both(at[k] >= zero, at[k] < last));
    cell[k] = hn::ConvertTo(ints, select(is_in, at[k], zero).v);
    t[k] = at[k] - Lanes(hn::ConvertTo(FloatTag(), cell[k]));
  }
  const Ints row = hn::Set(ints, field.count[0]);
  const Ints layer = hn::Set(ints, field.count[0] * field.count[1]);
  const Ints first = hn::Add(cell[0], hn::Add(hn::Mul(cell[1], row), hn::Mul(cell[2], layer)));
  Lanes lowest(HUGE_VALF), highest(0.0f), sum(0.0f);
  for (int i = 0; i < 8; ++i) {
    Ints place = i & 1 ? hn::Add(first, hn::Set(ints, 1)) : first;
    if (i & 2) place = hn::Add(place, row);
    if (i & 4) place = hn::Add(place, layer);
    const Lanes d = squares_m2(field, place);
    lowest = least(lowest, d);
    highest = greatest(highest, d);
    const Lanes x = i & 1 ? t[0] : one - t[0];
    const Lanes y = i & 2 ? t[1] : one - t[1];
    const Lanes z = i & 4 ? t[2] : one - t[2];
    sum = mul_add(x * y * z, d, sum);
  }
  const Lanes edge2(field.edge_m * field.edge_m);
  const Lanes sags = t[0] * (one - t[0]) + t[1] * (one - t[1]) + t[2] * (one - t[2]);
  const Lanes rounding = Lanes(kRoundedShare) * (highest + edge2);
  const Lanes bound_m2 = greatest(sum - edge2 * sags - rounding, zero);
  return select(both(is_in, lowest > zero), bound_m2, zero);
}

/// The same of a single point, in a cell that becomes known.
HWY_INLINE float field_bound_m2(const FieldGrid& grid, const LinkPatches& link,
                                const Eigen::Vector3f& p_L_m, int hint) {
  know_cell(grid, link, p_L_m, hint);
  return hn::GetLane(
      field_bounds_m2(grid.all(), {Lanes(p_L_m.x()), Lanes(p_L_m.y()), Lanes(p_L_m.z())}).v);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#endif
