// The directions from a robot pixel to the obstacle pixels of one tile, for the instruction set
// that the including file is being compiled for.
#if defined(BERTH_DISTANCE_DIRECTION_PIXEL_SUM_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_DIRECTION_PIXEL_SUM_INL_HPP
#undef BERTH_DISTANCE_DIRECTION_PIXEL_SUM_INL_HPP
#else
#define BERTH_DISTANCE_DIRECTION_PIXEL_SUM_INL_HPP
#endif

#include <algorithm>

#include "berth/distance/grid.hpp"
#include "berth/distance/mean_direction/direction_start-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// One coordinate of pair_vector() for some pixels: at_robot_m + per_gap * depth_gap_m().
struct AxisTerms {
  Lanes at_robot_m;
  Lanes per_gap;
};

HWY_INLINE AxisTerms axis_terms(Lanes robot_px, Lanes obstacle_px, Lanes principal_px,
                                Lanes robot_depth_m, Lanes inverse_focal) {
  const FacingSides<Lanes> side = facing_sides(robot_px, obstacle_px);
  return {(side.obstacle_px - side.robot_px) * robot_depth_m * inverse_focal,
          (side.obstacle_px - principal_px) * inverse_focal};
}

/// Adds the unit vector of each lane that counts, and returns their number. Its length is right
/// from 1e-15 m on.
template <bool kMayTouch>
HWY_INLINE std::size_t add_pairs(const Start& start, const AxisTerms& across, const AxisTerms& down,
                                 Lanes depth_m, LaneSums& sums) {
  const Lanes z_m = depth_gap_m(start.depth_m, depth_m);
  const Lanes x_m = multiply_add(across.per_gap, z_m, across.at_robot_m);
  const Lanes y_m = multiply_add(down.per_gap, z_m, down.at_robot_m);
  LaneMask counts = hn::Le(depth_m.v, start.max_depth_m.v);
  if constexpr (kMayTouch) {
    // Not the square, which may underflow.
    const Lanes size_m = absolute(x_m) + absolute(y_m) + z_m;
    counts = hn::And(counts, hn::Gt(size_m.v, Lanes(0).v));
  }
  const Lanes squared_m2 = multiply_add(x_m, x_m, multiply_add(y_m, y_m, z_m * z_m));
  const Lanes inverse = inverse_square_root(greatest(squared_m2, Lanes(1e-30f)));
  sums.x = sums.x + zero_unless(counts, x_m * inverse);
  sums.y = sums.y + zero_unless(counts, y_m * inverse);
  sums.z = sums.z + zero_unless(counts, z_m * inverse);
  return hn::CountTrue(FloatTag(), counts);
}

/// Adds the pixels whose bits are set, of the tile whose first pixel is (u, v). A tile that may
/// touch holds a pixel next to the robot pixel, or that one itself.
template <bool kMayTouch>
HWY_INLINE void add_pixels(const BasicMetric<Lanes>& metric, const Start& start,
                           const TileDepths& tile, std::uint64_t pixels, Lanes u, Lanes v,
                           LaneSums& sums) {
  std::size_t count = 0;
  for (int column = 0; column < kTilePx; column += kLanes) {
    const AxisTerms across = axis_terms(start.u, u + load(kTileGrid.column + column), metric.cx_px,
                                        start.depth_m, metric.inv_fx);
    for (int i = column; i < kTilePixels; i += std::max(kLanes, kTilePx)) {
      const AxisTerms down = axis_terms(start.v, v + load(kTileGrid.row + i), metric.cy_px,
                                        start.depth_m, metric.inv_fy);
      count += add_pairs<kMayTouch>(start, across, down,
                                    keep_where(pixels >> i, load_tile(tile, i)), sums);
    }
  }
  sums.pixels += count;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
