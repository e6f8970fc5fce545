// The pairs of one robot tile and one obstacle tile. Compiled once for each instruction set by
// exact_search.cpp; loops of a fixed length over plain arrays, which the compiler turns into
// vectors.
#if defined(BERTH_DISTANCE_EXACT_LEAF_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_EXACT_LEAF_INL_HPP
#undef BERTH_DISTANCE_EXACT_LEAF_INL_HPP
#else
#define BERTH_DISTANCE_EXACT_LEAF_INL_HPP
#endif

#include "thesis/exact/state-inl.hpp"
#include "thesis/exact/tile_bits.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// Pixels of one tile, closed up; NaN depths fill the last lanes. The box is set if there is any
/// pixel.
struct Pixels {
  alignas(64) float u[kTilePixels];
  alignas(64) float v[kTilePixels];
  alignas(64) float depth_m[kTilePixels];
  int count = 0;
  PixelBox box;
};

inline void close_up(std::uint64_t bits, const LeafTile& tile, Pixels& out) {
  out.count = 0;
  if (bits == 0) return;
  out.box = box_of_bits(bits, tile.u, tile.v);
  for (; bits != 0; bits &= bits - 1) {
    const int i = lowest_bit(bits);
    out.u[out.count] = tile.u + kTileGrid.column[i];
    out.v[out.count] = tile.v + kTileGrid.row[i];
    out.depth_m[out.count] = tile.depths.depth_m[i / kTilePx * tile.depths.stride + i % kTilePx];
    ++out.count;
  }
  for (int i = out.count; i % kLanes != 0; ++i) {
    out.u[i] = out.v[i] = 0;
    out.depth_m[i] = kNoDepth;
  }
}

/// Fills the depth range of the box.
inline void bound_depth(Pixels& pixels) {
  Lanes lo_m(HUGE_VALF);
  Lanes hi_m(-HUGE_VALF);
  for (int i = 0; i < pixels.count; i += kLanes) {
    const Lanes depth_m = load(pixels.depth_m + i);
    lo_m = lesser_or_first(lo_m, depth_m);
    hi_m = greater_or_first(hi_m, depth_m);
  }
  pixels.box.depth_lo_m = least_lane(lo_m);
  pixels.box.depth_hi_m = greatest_lane(hi_m);
}

/// The pixels of a tile as boxes, for the lanes from pixel i on.
HWY_INLINE BasicPixelBox<Lanes> pixel_boxes(const LeafTile& tile, int i) {
  const Lanes u_lo = Lanes(tile.u) + load(kTileGrid.column + i);
  const Lanes v_lo = Lanes(tile.v) + load(kTileGrid.row + i);
  const Lanes depth_m = depths_of(tile, i);
  return {u_lo, u_lo + Lanes(1), v_lo, v_lo + Lanes(1), depth_m, depth_m};
}

/// The obstacle tile's pixels that may improve on the best pair with robot pixels in a box.
inline void keep_obstacle_pixels(const Search& search, const PixelBox& robot, const LeafTile& tile,
                                 Pixels& out) {
  const BasicPixelBox<Lanes> box = broadcast(robot);
  std::uint64_t bits = 0;
  for (int i = 0; i < kTilePixels; i += kLanes) {
    const Lanes bound_m2 =
        lower_bound_m2(search.metric, box, pixel_boxes(tile, i), Lanes(search.max_gap_m));
    bits |= bits_less(bound_m2, Lanes(search.limit_m2)) << i;
  }
  close_up(bits, tile, out);
}

/// The robot tile's pixels that may improve on the best pair with obstacle pixels in a box.
inline void keep_robot_pixels(const Search& search, const LeafTile& tile, const PixelBox& obstacle,
                              Pixels& out) {
  const BasicPixelBox<Lanes> box = broadcast(obstacle);
  std::uint64_t bits = 0;
  for (int i = 0; i < kTilePixels; i += kLanes) {
    const Lanes bound_m2 =
        lower_bound_m2(search.metric, pixel_boxes(tile, i), box, Lanes(search.max_gap_m));
    bits |= bits_less(bound_m2, Lanes(search.limit_m2)) << i;
  }
  close_up(bits, tile, out);
}

/// Takes the closest of the lanes' pairs; pair = 64 r + o for robot pixel r and obstacle pixel o +
/// lane.
inline void take_least(Search& search, const Pixels& robot, const Pixels& obstacle, Lanes least_m2,
                       Lanes pair) {
  alignas(64) float lane_m2[kLanes];
  alignas(64) float lane_pair[kLanes];
  store(least_m2, lane_m2);
  store(pair, lane_pair);
  for (int i = 0; i < kLanes; ++i) {
    if (!(lane_m2[i] < search.best.squared_m2)) continue;
    const int r = static_cast<int>(lane_pair[i]) / kTilePixels;
    const int o = static_cast<int>(lane_pair[i]) % kTilePixels + i;
    search.best = {lane_m2[i],    robot.u[r],    robot.v[r],         robot.depth_m[r],
                   obstacle.u[o], obstacle.v[o], obstacle.depth_m[o]};
  }
  update_limit(search);
}

/// Along one axis: +1 if every obstacle pixel lies beyond every robot pixel, -1 if before, 0 else.
inline int side_of(float robot_lo, float robot_hi, float obstacle_lo, float obstacle_hi) {
  return obstacle_lo >= robot_hi ? 1 : obstacle_hi <= robot_lo ? -1 : 0;
}

/// axis_offset_px_m for fixed obstacle pixels. Where they all lie on one side, the facing sides are
/// known once for all robot pixels: the same operations on the same numbers, so the same bits.
template <bool one_sided>
struct AxisOffset {
  Lanes obstacle_px;
  Lanes principal_px;
  Lanes from_principal_px;
  float robot_shift_px;

  HWY_INLINE AxisOffset(int side, const float* pixels, Lanes principal)
      : obstacle_px(load(pixels) + Lanes(side < 0 ? 1.0f : 0.0f)),
        principal_px(principal),
        from_principal_px(obstacle_px - principal),
        robot_shift_px(side > 0 ? 1.0f : 0.0f) {}

  HWY_INLINE Lanes operator()(float robot_px, Lanes robot_depth_m, Lanes gap_m) const {
    if constexpr (one_sided) {
      return (obstacle_px - Lanes(robot_px + robot_shift_px)) * robot_depth_m +
             from_principal_px * gap_m;
    } else {
      return axis_offset_px_m(facing_sides(Lanes(robot_px), obstacle_px), principal_px,
                              robot_depth_m, gap_m);
    }
  }
};

/// Evaluates every pair; the obstacle pixels go side by side.
template <bool u_one_sided, bool v_one_sided>
inline void try_pairs_sided(Search& search, const Pixels& robot, const Pixels& obstacle, int u_side,
                            int v_side) {
  Lanes least_m2(search.best.squared_m2);
  Lanes pair(-1);
  for (int o = 0; o < obstacle.count; o += kLanes) {
    const AxisOffset<u_one_sided> along_u(u_side, obstacle.u + o, search.metric.cx_px);
    const AxisOffset<v_one_sided> along_v(v_side, obstacle.v + o, search.metric.cy_px);
    const Lanes obstacle_depth_m = load(obstacle.depth_m + o);
    for (int r = 0; r < robot.count; ++r) {
      const Lanes depth_m(robot.depth_m[r]);
      const Lanes gap_m = depth_gap_m(depth_m, obstacle_depth_m);
      const Lanes squared_m2 = squared_length_m2(BasicPairVector<Lanes>{
          along_u(robot.u[r], depth_m, gap_m) * search.metric.inv_fx,
          along_v(robot.v[r], depth_m, gap_m) * search.metric.inv_fy, gap_m});
      const auto closer = hn::Lt(squared_m2.v, least_m2.v);
      least_m2 = hn::IfThenElse(closer, squared_m2.v, least_m2.v);
      pair = hn::IfThenElse(closer, Lanes(static_cast<float>(r * kTilePixels + o)).v, pair.v);
    }
  }
  search.pairs += static_cast<std::int64_t>(robot.count) * obstacle.count;
  if (bits_less(least_m2, Lanes(search.best.squared_m2)) == 0) return;
  take_least(search, robot, obstacle, least_m2, pair);
}

inline void try_pairs(Search& search, const Pixels& robot, const Pixels& obstacle) {
  if (robot.count == 0 || obstacle.count == 0) return;
  const int u = side_of(robot.box.u_lo, robot.box.u_hi, obstacle.box.u_lo, obstacle.box.u_hi);
  const int v = side_of(robot.box.v_lo, robot.box.v_hi, obstacle.box.v_lo, obstacle.box.v_hi);
  if (u != 0 && v != 0) return try_pairs_sided<true, true>(search, robot, obstacle, u, v);
  if (u != 0) return try_pairs_sided<true, false>(search, robot, obstacle, u, v);
  if (v != 0) return try_pairs_sided<false, true>(search, robot, obstacle, u, v);
  try_pairs_sided<false, false>(search, robot, obstacle, u, v);
}

/// Obstacle pixels are sorted out first: mostly none is left, and the robot pixels need no look.
inline void search_leaf(Search& search, const LeafTile& robot_tile, const LeafTile& obstacle_tile) {
  Pixels obstacle;
  keep_obstacle_pixels(search, robot_tile.box, obstacle_tile, obstacle);
  if (obstacle.count == 0) return;
  bound_depth(obstacle);
  Pixels robot;
  keep_robot_pixels(search, robot_tile, obstacle.box, robot);
  try_pairs(search, robot, obstacle);
}

/// The same along the surface of the robot tile, then quarter by quarter: the smaller the box, the
/// fewer pixels are near to it.
inline void search_leaf_aligned(Search& search, const AlignedTile& aligned,
                                const LeafTile& robot_tile, const LeafTile& obstacle_tile) {
  const AlignedCamera view(search.input.metric, aligned.axes, obstacle_tile,
                           {robot_tile.box.depth_lo_m, robot_tile.box.depth_hi_m});
  if (view.pixels_near(aligned.box, search.limit_m2) == 0) return;
  Pixels robot;
  Pixels obstacle;
  for (int q = 0; q < 4; ++q) {
    const std::uint64_t near = view.pixels_near(aligned.quarters[q], search.limit_m2);
    if (near == 0) continue;
    close_up(near, obstacle_tile, obstacle);
    close_up(robot_tile.bits & kQuarters[q], robot_tile, robot);
    try_pairs(search, robot, obstacle);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
