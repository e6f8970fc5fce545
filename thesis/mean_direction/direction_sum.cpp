#include "thesis/mean_direction/direction_sum.hpp"

#include <bit>

#include "thesis/depth_tile.hpp"
#include "thesis/grid.hpp"
#include "thesis/mean_direction/tile_pixels.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "thesis/mean_direction/direction_sum.cpp"
#include "hwy/foreach_target.h"

#include "thesis/metric_lanes-inl.hpp"
#include "thesis/tile_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

constexpr int kTiles = TileMeans::kTiles;

/// The second derivative of a unit vector x / |x| along a line is at most 1.16 / |x|^2. So with all
/// points in a ball of radius R and their mean at the distance D, the mean of their directions
/// differs from that of their mean by 0.58 (R / (D - 2 R))^2 at most: by 0.017 here.
constexpr float kFarTile = 1.0f / 8;

/// A robot pixel, and which obstacle pixels count for it.
struct Watch {
  BasicMetric<Lanes> metric;
  Lanes u;
  Lanes v;
  Lanes depth_m;
  Lanes max_depth_m;
  PixelRect rect;

  HWY_INLINE Watch(const Metric& m, const DirectionSum& sum)
      : metric(broadcast(m)),
        u(sum.u),
        v(sum.v),
        depth_m(sum.depth_m),
        max_depth_m(sum.max_depth_m),
        rect(sum.rect) {}
};

/// 1 / sqrt(x) for normal x > 0, to 5e-5 or better (the worst is NEON's estimate of 8 bits): not
/// the same bits everywhere.
HWY_INLINE Lanes inverse_square_root(Lanes x) {
  const Lanes estimate = hn::ApproximateReciprocalSqrt(x.v);
  return estimate * (Lanes(1.5f) - Lanes(0.5f) * x * estimate * estimate);
}

/// Unit vectors and their number, lane by lane.
struct UnitVectors {
  Lanes x;
  Lanes y;
  Lanes z;
  Lanes count;

  HWY_INLINE UnitVectors() : x(0), y(0), z(0), count(0) {}

  /// Adds `how_many` times the direction of each vector that counts; its length is right from
  /// 1e-15 m on.
  HWY_INLINE void add(LaneMask counts, const BasicPairVector<Lanes>& vector_m, Lanes squared_m2,
                      Lanes how_many) {
    const auto only = [&](Lanes number)
                          HWY_ATTR { return Lanes(hn::IfThenElseZero(counts, number.v)); };
    const Lanes weight = how_many * inverse_square_root(greatest(squared_m2, Lanes(1e-30f)));
    x = x + only(weight * vector_m.x_m);
    y = y + only(weight * vector_m.y_m);
    z = z + only(weight * vector_m.z_m);
    count = count + only(how_many);
  }

  HWY_INLINE void add_to(DirectionSum& sum) const {
    sum.x += sum_of_lanes(x);
    sum.y += sum_of_lanes(y);
    sum.z += sum_of_lanes(z);
    sum.count += static_cast<std::int64_t>(sum_of_lanes(count));
  }
};

/// The pixels of one tile, whose first is (u, v), one by one.
HWY_INLINE void add_pixels(const Watch& watch, const DepthSquare& tile, std::uint64_t pixels,
                           float u, float v, UnitVectors& out) {
  for (int i = 0; i < kTilePixels; i += kLanes) {
    const Lanes depth_m = keep_where(pixels >> i, load_tile(tile, i));
    const BasicPairVector<Lanes> vector_m =
        pair_vector(watch.metric, watch.u, watch.v, watch.depth_m,
                    Lanes(u) + load(kTileGrid.column + i % kTilePx),
                    Lanes(v) + load(kTileGrid.row + i), depth_m);
    const Lanes squared_m2 = squared_length_m2(vector_m);
    const LaneMask counts =
        hn::And(hn::Le(depth_m.v, watch.max_depth_m.v), hn::Gt(squared_m2.v, hn::Zero(FloatTag())));
    out.add(counts, vector_m, squared_m2, Lanes(1));
  }
}

/// Which side of the robot pixel's column or row a vector of tiles lies on: 1 where it does.
struct Sides {
  LaneMask below;
  LaneMask above;

  HWY_INLINE Sides(Lanes tile_px, Lanes robot_px)
      : below(hn::Lt((tile_px + Lanes(kTilePx - 1)).v, robot_px.v)),
        above(hn::Gt(tile_px.v, robot_px.v)) {}
  HWY_INLINE Lanes is_below() const { return hn::IfThenElseZero(below, Lanes(1).v); }
  HWY_INLINE Lanes is_above() const { return hn::IfThenElseZero(above, Lanes(1).v); }
};

/// The tiles that touch [begin, end), and those that lie in it.
struct Cut {
  LaneMask some;
  LaneMask all;

  HWY_INLINE Cut(Lanes tile_px, int begin, int end)
      : some(hn::And(hn::Gt((tile_px + Lanes(kTilePx)).v, Lanes(static_cast<float>(begin)).v),
                     hn::Lt(tile_px.v, Lanes(static_cast<float>(end)).v))),
        all(hn::And(hn::Ge(tile_px.v, Lanes(static_cast<float>(begin)).v),
                    hn::Le((tile_px + Lanes(kTilePx)).v, Lanes(static_cast<float>(end)).v))) {}
};

/// Adds the tiles i, i + 1, ... of the node at (u, v) that stand for their pixels; returns those
/// whose pixels have to be looked at one by one: near ones, those that share columns or rows with
/// the robot pixel, and those that the rectangle, the robot's depth or the greatest depth cuts.
HWY_INLINE std::uint64_t add_far_tiles(const Watch& watch, const ObstacleTree::Node& ranges,
                                       const TileMeans::Node& means, float radius, float u, float v,
                                       int i, UnitVectors& out) {
  const BasicMetric<Lanes>& metric = watch.metric;
  const Lanes tile_u = Lanes(u) + Lanes(kTilePx) * load(kNodeGrid.column + i);
  const Lanes tile_v = Lanes(v) + Lanes(kTilePx) * load(kNodeGrid.row + i);
  const Lanes lo_m = load(ranges.depth_lo_m + i);
  const Lanes hi_m = load(ranges.depth_hi_m + i);
  const Cut cut_u(tile_u, watch.rect.u_begin, watch.rect.u_end);
  const Cut cut_v(tile_v, watch.rect.v_begin, watch.rect.v_end);
  const LaneMask some =
      hn::And(hn::Le(lo_m.v, watch.max_depth_m.v), hn::And(cut_u.some, cut_v.some));
  if (hn::AllFalse(FloatTag(), some)) return 0;

  // What lies in front of the robot counts at its depth (gray area, Hirt 2.14).
  const LaneMask in_front = hn::Le(hi_m.v, watch.depth_m.v);
  const LaneMask behind = hn::Ge(lo_m.v, watch.depth_m.v);
  const auto at_depth = [&](const float* x, const float* x_m) HWY_ATTR {
    return Lanes(hn::IfThenElse(in_front, (load(x + i) * watch.depth_m).v, load(x_m + i).v));
  };
  const Lanes z_m = hn::IfThenElse(in_front, watch.depth_m.v, load(means.z_m + i).v);
  const Lanes radius_m =
      hn::IfThenElse(in_front, (Lanes(radius) * watch.depth_m).v, load(means.radius_m + i).v);
  const Sides u_side(tile_u, watch.u);
  const Sides v_side(tile_v, watch.v);
  const Lanes robot_x_px = watch.u - metric.cx_px + u_side.is_above();
  const Lanes robot_y_px = watch.v - metric.cy_px + v_side.is_above();
  const BasicPairVector<Lanes> vector_m{
      at_depth(means.x, means.x_m) +
          (u_side.is_below() * z_m - robot_x_px * watch.depth_m) * metric.inv_fx,
      at_depth(means.y, means.y_m) +
          (v_side.is_below() * z_m - robot_y_px * watch.depth_m) * metric.inv_fy,
      z_m - watch.depth_m};
  const Lanes squared_m2 = squared_length_m2(vector_m);

  const LaneMask one_sided =
      hn::And(hn::Or(u_side.below, u_side.above), hn::Or(v_side.below, v_side.above));
  const LaneMask uncut =
      hn::And(hn::And(cut_u.all, cut_v.all),
              hn::And(hn::Le(hi_m.v, watch.max_depth_m.v), hn::Or(in_front, behind)));
  const LaneMask is_far =
      hn::Le((radius_m * radius_m).v, (Lanes(kFarTile * kFarTile) * squared_m2).v);
  const LaneMask good = hn::And(hn::And(some, uncut), hn::And(one_sided, is_far));
  out.add(good, vector_m, squared_m2, load(means.count + i));
  return bits_of(hn::AndNot(good, some));
}

void add_near_tiles(const Watch& watch, DepthView obstacle_depth_m, int u, int v,
                    std::uint64_t tiles, UnitVectors& out) {
  DepthSquareCopy<kTilePx> copy;
  for (; tiles != 0; tiles &= tiles - 1) {
    const int i = std::countr_zero(tiles);
    const int tile_u = u + i % 4 * kTilePx;
    const int tile_v = v + i / 4 * kTilePx;
    const std::uint64_t pixels =
        pixels_within(watch.rect.u_begin - tile_u, watch.rect.v_begin - tile_v,
                      watch.rect.u_end - tile_u, watch.rect.v_end - tile_v);
    add_pixels(watch, depth_square<kTilePx>(obstacle_depth_m, tile_u, tile_v, copy), pixels,
               static_cast<float>(tile_u), static_cast<float>(tile_v), out);
  }
}

void add_nodes(const Metric& metric, const SearchableDepth& obstacles, const TileMeans& means,
               DirectionSum& sum) {
  const Watch watch(metric, sum);
  const ObstacleTree::Level& level = obstacles.tree().levels[0];
  const PixelRect nodes = nodes_within(obstacles.tree(), sum.rect);
  for (int row = nodes.v_begin; row < nodes.v_end; ++row) {
    // So few that sums in float are good.
    UnitVectors vectors;
    for (int column = nodes.u_begin; column < nodes.u_end; ++column) {
      const int n = row * level.columns + column;
      const int u = column * kNodePx;
      const int v = row * kNodePx;
      std::uint64_t near = 0;
      for (int i = 0; i < kTiles; i += kLanes) {
        near |= add_far_tiles(watch, level.nodes[n], means.nodes[n], means.radius,
                              static_cast<float>(u), static_cast<float>(v), i, vectors)
                << i;
      }
      if (near != 0) add_near_tiles(watch, obstacles.depth_m(), u, v, near, vectors);
    }
    vectors.add_to(sum);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(add_nodes);

void add_directions(const Metric& metric, const SearchableDepth& obstacles, const TileMeans& means,
                    DirectionSum& sum) {
  HWY_DYNAMIC_DISPATCH(add_nodes)(metric, obstacles, means, sum);
}

}  // namespace berth
#endif  // HWY_ONCE
