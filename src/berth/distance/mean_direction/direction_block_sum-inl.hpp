// The directions from a robot pixel to blocks of obstacle pixels, for the instruction set that the
// including file is being compiled for.
#if defined(BERTH_DISTANCE_DIRECTION_BLOCK_SUM_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_DIRECTION_BLOCK_SUM_INL_HPP
#undef BERTH_DISTANCE_DIRECTION_BLOCK_SUM_INL_HPP
#else
#define BERTH_DISTANCE_DIRECTION_BLOCK_SUM_INL_HPP
#endif

#include "berth/distance/mean_direction/direction_blocks.hpp"
#include "berth/distance/mean_direction/direction_start-inl.hpp"
#include "berth/distance/mean_direction/facing_fractions.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

using Chunk = DirectionBlocks::Chunk;

/// FacingFractions of a vector of blocks.
struct Facing {
  Lanes u_below;
  Lanes u_above;
  Lanes v_below;
  Lanes v_above;
  /// The blocks that share columns or rows with the robot pixel: their pixels face different sides.
  LaneMask shared;
};

HWY_INLINE Facing facing_blocks(const Start& start, const Chunk& c, int i) {
  const Lanes u = load(c.u + i);
  const Lanes v = load(c.v + i);
  const Lanes last(7);
  const LaneMask u_below = hn::Lt((u + last).v, start.u.v);
  const LaneMask u_above = hn::Gt(u.v, start.u.v);
  const LaneMask v_below = hn::Lt((v + last).v, start.v.v);
  const LaneMask v_above = hn::Gt(v.v, start.v.v);
  const LaneMask apart = hn::And(hn::Or(u_below, u_above), hn::Or(v_below, v_above));
  const Lanes one(1);
  return {zero_unless(u_below, one), zero_unless(u_above, one), zero_unless(v_below, one),
          zero_unless(v_above, one), hn::Not(apart)};
}

/// Counts pixels in the blocks that share columns or rows with the robot pixel.
void count_shared(const Start& start, const Chunk& c, int i, std::uint64_t blocks, Facing& facing) {
  alignas(64) float fractions[4][kLanes];
  store(facing.u_below, fractions[0]);
  store(facing.u_above, fractions[1]);
  store(facing.v_below, fractions[2]);
  store(facing.v_above, fractions[3]);
  const float u = hn::GetLane(start.u.v);
  const float v = hn::GetLane(start.v.v);
  for (; blocks != 0; blocks &= blocks - 1) {
    const int lane = std::countr_zero(blocks);
    const std::uint64_t pixels = c.pixels[i + lane];
    const FacingFractions columns =
        fractions_of_columns(pixels, static_cast<int>(u - c.u[i + lane]));
    const FacingFractions rows = fractions_of_rows(pixels, static_cast<int>(v - c.v[i + lane]));
    fractions[0][lane] = columns.below;
    fractions[1][lane] = columns.above;
    fractions[2][lane] = rows.below;
    fractions[3][lane] = rows.above;
  }
  facing.u_below = load(fractions[0]);
  facing.u_above = load(fractions[1]);
  facing.v_below = load(fractions[2]);
  facing.v_above = load(fractions[3]);
}

/// Mean and covariance of the obstacle points of a vector of blocks, from the robot point.
struct Cloud {
  Lanes x_m;
  Lanes y_m;
  Lanes z_m;
  Lanes xx_m2;
  Lanes xy_m2;
  Lanes xz_m2;
  Lanes yy_m2;
  Lanes yz_m2;
  Lanes zz_m2;
  Lanes reach_m;
};

HWY_INLINE Cloud load_cloud(const Chunk& c, int i) {
  return {load(c.x_m + i),   load(c.y_m + i),    load(c.z_m + i),   load(c.xx_m2 + i),
          load(c.xy_m2 + i), load(c.xz_m2 + i),  load(c.yy_m2 + i), load(c.yz_m2 + i),
          load(c.zz_m2 + i), load(c.reach_m + i)};
}

/// Moves the chosen blocks, which lie in front of the robot, to its depth (gray area, Hirt 2.14).
HWY_INLINE void move_back(const Start& start, const Chunk& c, int i, LaneMask in_front,
                          Cloud& cloud) {
  const Lanes zero(0);
  const Lanes z_m = start.depth_m;
  const Lanes squared_z_m2 = z_m * z_m;
  const Lanes xx_m2 = load(c.tangent_xx + i) * squared_z_m2;
  const Lanes yy_m2 = load(c.tangent_yy + i) * squared_z_m2;
  cloud.x_m = choose(in_front, load(c.tangent_x + i) * z_m, cloud.x_m);
  cloud.y_m = choose(in_front, load(c.tangent_y + i) * z_m, cloud.y_m);
  cloud.z_m = choose(in_front, z_m, cloud.z_m);
  cloud.xx_m2 = choose(in_front, xx_m2, cloud.xx_m2);
  cloud.xy_m2 = choose(in_front, load(c.tangent_xy + i) * squared_z_m2, cloud.xy_m2);
  cloud.xz_m2 = choose(in_front, zero, cloud.xz_m2);
  cloud.yy_m2 = choose(in_front, yy_m2, cloud.yy_m2);
  cloud.yz_m2 = choose(in_front, zero, cloud.yz_m2);
  cloud.zz_m2 = choose(in_front, zero, cloud.zz_m2);
  cloud.reach_m = choose(in_front, load(c.tangent_reach + i) * z_m, cloud.reach_m);
}

/// A bound of what else the mean direction of blocks that share columns or rows is wrong by: facing
/// sides bring their points closer together, and may go along with the depth.
HWY_INLINE Lanes shared_error(const BasicMetric<Lanes>& metric, const Chunk& c, int i, Lanes zz_m2,
                              Lanes depth_m, Lanes inverse_distance) {
  const Lanes first_m = Lanes(0.5f) * Lanes(hn::Sqrt(zz_m2.v)) * (metric.inv_fx + metric.inv_fy);
  const Lanes second = Lanes(hn::Sqrt(load(c.tangent_xx + i).v)) * metric.inv_fx +
                       Lanes(hn::Sqrt(load(c.tangent_yy + i).v)) * metric.inv_fy;
  return (first_m + Lanes(1.6f) * second * depth_m * depth_m * inverse_distance) * inverse_distance;
}

/// Takes from `some` the blocks that have no pixel in the rectangle, and from `all` those that have
/// one outside.
HWY_INLINE void cut(const PixelRect& rect, Lanes u, Lanes v, LaneMask& some, LaneMask& all) {
  const Lanes u_begin(static_cast<float>(rect.u_begin));
  const Lanes v_begin(static_cast<float>(rect.v_begin));
  const Lanes u_end(static_cast<float>(rect.u_end));
  const Lanes v_end(static_cast<float>(rect.v_end));
  const Lanes size(kTilePx);
  const LaneMask touches_u = hn::And(hn::Gt((u + size).v, u_begin.v), hn::Lt(u.v, u_end.v));
  const LaneMask touches_v = hn::And(hn::Gt((v + size).v, v_begin.v), hn::Lt(v.v, v_end.v));
  const LaneMask within_u = hn::And(hn::Ge(u.v, u_begin.v), hn::Le((u + size).v, u_end.v));
  const LaneMask within_v = hn::And(hn::Ge(v.v, v_begin.v), hn::Le((v + size).v, v_end.v));
  some = hn::And(some, hn::And(touches_u, touches_v));
  all = hn::And(all, hn::And(within_u, within_v));
}

/// Moves the origin from the camera to the facing side of the robot pixel, and the points to
/// theirs.
HWY_INLINE void start_from_robot(const BasicMetric<Lanes>& metric, const Start& start,
                                 const Facing& facing, Cloud& cloud) {
  const Lanes robot_u_px = start.u - metric.cx_px + facing.u_above;
  const Lanes robot_v_px = start.v - metric.cy_px + facing.v_above;
  cloud.x_m = cloud.x_m + (facing.u_below * cloud.z_m - robot_u_px * start.depth_m) * metric.inv_fx;
  cloud.y_m = cloud.y_m + (facing.v_below * cloud.z_m - robot_v_px * start.depth_m) * metric.inv_fy;
  cloud.z_m = cloud.z_m - start.depth_m;
}

/// A bound of what the mean directions of add_directions() are wrong by. The third derivative of a
/// unit vector along a line is at most 3 / D^3, and D at least 2/3 of the mean's distance where the
/// reach is at most a third of it; infinity where it is more.
HWY_INLINE Lanes third_order_error(const Cloud& cloud, Lanes inverse_distance) {
  const Lanes reach = cloud.reach_m * inverse_distance;
  const Lanes variance_m2 = cloud.xx_m2 + cloud.yy_m2 + cloud.zz_m2;
  const Lanes error = Lanes(1.7f) * reach * variance_m2 * inverse_distance * inverse_distance;
  return choose(hn::Le(reach.v, Lanes(1.0f / 3).v), error, Lanes(HUGE_VALF));
}

/// To second order in the deviations from the mean, a block's mean direction is
/// n + (3/2 (n C n) - 1/2 tr C) n / D^2 - C n / D^2, with C their covariance, D the mean's distance
/// and n its direction. Adds `count` times that.
HWY_INLINE void add_directions(const Cloud& cloud, Lanes inverse_distance, Lanes count,
                               LaneSums& sums) {
  const Lanes nx = cloud.x_m * inverse_distance;
  const Lanes ny = cloud.y_m * inverse_distance;
  const Lanes nz = cloud.z_m * inverse_distance;
  const Lanes cx = multiply_add(cloud.xx_m2, nx, multiply_add(cloud.xy_m2, ny, cloud.xz_m2 * nz));
  const Lanes cy = multiply_add(cloud.xy_m2, nx, multiply_add(cloud.yy_m2, ny, cloud.yz_m2 * nz));
  const Lanes cz = multiply_add(cloud.xz_m2, nx, multiply_add(cloud.yz_m2, ny, cloud.zz_m2 * nz));
  const Lanes along_m2 = multiply_add(cx, nx, multiply_add(cy, ny, cz * nz));
  const Lanes variance_m2 = cloud.xx_m2 + cloud.yy_m2 + cloud.zz_m2;
  const Lanes weight = count * inverse_distance * inverse_distance;
  const Lanes length =
      multiply_add(weight, Lanes(1.5f) * along_m2 - Lanes(0.5f) * variance_m2, count);
  sums.x = sums.x + subtract_product(length * nx, weight, cx);
  sums.y = sums.y + subtract_product(length * ny, weight, cy);
  sums.z = sums.z + subtract_product(length * nz, weight, cz);
  sums.count = sums.count + count;
}

/// Adds the blocks of the chunk's lanes i, i + 1, ... that are far enough away to stand for their
/// pixels; returns those whose pixels have to be looked at one by one.
HWY_INLINE std::uint64_t add_blocks(const BasicMetric<Lanes>& metric, const Start& start,
                                    Lanes max_error, const Chunk& c, int i, LaneSums& sums) {
  const FloatTag d;
  const Lanes lo_m = load(c.depth_lo_m + i);
  const Lanes hi_m = load(c.depth_hi_m + i);
  LaneMask some = hn::Le(lo_m.v, start.max_depth_m.v);
  LaneMask good = hn::Le(hi_m.v, start.max_depth_m.v);
  if (start.is_cut) cut(start.rect, load(c.u + i), load(c.v + i), some, good);
  if (hn::AllFalse(d, some)) return 0;

  Cloud cloud = load_cloud(c, i);
  const LaneMask in_front = hn::Le(hi_m.v, start.depth_m.v);
  if (!hn::AllFalse(d, in_front)) move_back(start, c, i, in_front, cloud);
  good = hn::And(good, hn::Or(in_front, hn::Ge(lo_m.v, start.depth_m.v)));

  Facing facing = facing_blocks(start, c, i);
  const bool any_shared = !hn::AllFalse(d, facing.shared);
  if (any_shared) count_shared(start, c, i, bits_of(hn::And(good, facing.shared)), facing);
  const Lanes obstacle_depth_m = cloud.z_m;
  start_from_robot(metric, start, facing, cloud);

  const Lanes squared_m2 =
      multiply_add(cloud.x_m, cloud.x_m, multiply_add(cloud.y_m, cloud.y_m, cloud.z_m * cloud.z_m));
  const Lanes inverse = inverse_square_root(squared_m2);
  Lanes error = third_order_error(cloud, inverse);
  if (any_shared) {
    const Lanes more = shared_error(metric, c, i, cloud.zz_m2, obstacle_depth_m, inverse);
    error = error + zero_unless(facing.shared, more);
  }
  good = hn::And(hn::And(some, good), hn::Le(error.v, max_error.v));
  const Lanes count = zero_unless(good, load(c.count + i));
  add_directions(cloud, zero_unless(good, inverse), count, sums);
  sums.error = sums.error + count * zero_unless(good, error);
  return bits_of(hn::AndNot(good, some));
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
