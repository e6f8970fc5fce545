// The pairs of one robot tile and one obstacle tile. Compiled once for each instruction set by
// exact_search.cpp; loops of a fixed length over plain arrays, which the compiler turns into
// vectors.
#if defined(BERTH_DISTANCE_EXACT_LEAF_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_EXACT_LEAF_INL_HPP
#undef BERTH_DISTANCE_EXACT_LEAF_INL_HPP
#else
#define BERTH_DISTANCE_EXACT_LEAF_INL_HPP
#endif

#include "berth/distance/exact_search.hpp"
#include "berth/distance/grid.hpp"
#include "berth/distance/lanes-inl.hpp"
#include "berth/distance/tile_bits.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

constexpr int kTilePixels = ObstacleTree::kTilePixels;

/// The best pair so far of one link, and what follows from it.
struct Search {
  BasicMetric<Lanes> metric;
  const RobotTiles& robot;
  const ObstacleTree& obstacles;
  ClosestPair& best;
  /// A pair with a larger depth gap is no closer than `best`.
  float max_gap_m;
  std::int64_t pairs;
};

/// Above the square root of best_m2 by more than all roundings.
inline float max_gap_of(float best_m2) {
  return std::sqrt(best_m2) * (1 + 8 * std::numeric_limits<float>::epsilon());
}

/// Pixels of one tile, closed up; NaN depths fill the last lanes. The box is set if there is any
/// pixel.
struct Pixels {
  alignas(64) float u[kTilePixels];
  alignas(64) float v[kTilePixels];
  alignas(64) float depth_m[kTilePixels];
  int count = 0;
  PixelBox box;
};

/// A tile's tight box, corner, and depths by rows.
struct LeafTile {
  PixelBox box;
  float u;
  float v;
  const float* depth_m;
};

inline void close_up(std::uint64_t bits, const LeafTile& tile, Pixels& out) {
  out.count = 0;
  if (bits == 0) return;
  out.box = box_of_bits(bits, tile.u, tile.v);
  for (; bits != 0; bits &= bits - 1) {
    const int i = lowest_bit(bits);
    out.u[out.count] = tile.u + kTileGrid.column[i];
    out.v[out.count] = tile.v + kTileGrid.row[i];
    out.depth_m[out.count] = tile.depth_m[i];
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
  const Lanes depth_m = load(tile.depth_m + i);
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
    bits |= bits_less(bound_m2, Lanes(search.best.squared_m2)) << i;
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
    bits |= bits_less(bound_m2, Lanes(search.best.squared_m2)) << i;
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
  search.max_gap_m = max_gap_of(search.best.squared_m2);
}

/// Evaluates every pair; the obstacle pixels go side by side.
inline void try_pairs(Search& search, const Pixels& robot, const Pixels& obstacle) {
  Lanes least_m2(search.best.squared_m2);
  Lanes pair(-1);
  for (int o = 0; o < obstacle.count; o += kLanes) {
    const Lanes u = load(obstacle.u + o);
    const Lanes v = load(obstacle.v + o);
    const Lanes depth_m = load(obstacle.depth_m + o);
    for (int r = 0; r < robot.count; ++r) {
      const Lanes squared_m2 =
          squared_distance_m2(search.metric, Lanes(robot.u[r]), Lanes(robot.v[r]),
                              Lanes(robot.depth_m[r]), u, v, depth_m);
      const auto closer = hn::Lt(squared_m2.v, least_m2.v);
      least_m2 = hn::IfThenElse(closer, squared_m2.v, least_m2.v);
      pair = hn::IfThenElse(closer, Lanes(static_cast<float>(r * kTilePixels + o)).v, pair.v);
    }
  }
  search.pairs += static_cast<std::int64_t>(robot.count) * obstacle.count;
  if (bits_less(least_m2, Lanes(search.best.squared_m2)) == 0) return;
  take_least(search, robot, obstacle, least_m2, pair);
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

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
