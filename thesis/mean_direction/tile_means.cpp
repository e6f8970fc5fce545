#include "thesis/mean_direction/tile_means.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "thesis/depth_tile.hpp"
#include "thesis/grid.hpp"
#include "thesis/metric.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "thesis/mean_direction/tile_means.cpp"
#include "hwy/foreach_target.h"

#include "thesis/metric_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// The columns of 8 pixels in a node.
constexpr int kColumns = TileMeans::kTiles * kTilePx;

/// Sums over the readings of each column, then of each tile; u and v from the tile's corner.
struct TileSums {
  alignas(64) float count[kColumns];
  alignas(64) float u[kColumns];
  alignas(64) float v[kColumns];
  alignas(64) float z_m[kColumns];
  alignas(64) float uz_m[kColumns];
  alignas(64) float vz_m[kColumns];
};

HWY_INLINE void sum_columns(const DepthSquare& node, TileSums& out) {
  for (int i = 0; i < kColumns; i += kLanes) {
    const float* column_m = node.depth_m + (i / kNodePx) * kTilePx * node.stride + i % kNodePx;
    Lanes count(0), v_sum(0), z_m(0), vz_m(0);
    for (int row = 0; row < kTilePx; ++row) {
      const Lanes depth_m = load(column_m + row * node.stride);
      const LaneMask there = hn::Eq(depth_m.v, depth_m.v);
      const Lanes one = hn::IfThenElseZero(there, Lanes(1).v);
      const Lanes reading_m = hn::IfThenElseZero(there, depth_m.v);
      const Lanes v(static_cast<float>(row));
      count = count + one;
      v_sum = v_sum + v * one;
      z_m = z_m + reading_m;
      vz_m = vz_m + v * reading_m;
    }
    const Lanes u = load(kTileGrid.column + i % kTilePixels);
    store(count, out.count + i);
    store(u * count, out.u + i);
    store(v_sum, out.v + i);
    store(z_m, out.z_m + i);
    store(u * z_m, out.uz_m + i);
    store(vz_m, out.vz_m + i);
  }
}

/// Adds up each 8 neighbours.
HWY_INLINE void add_up_columns(float* sums) {
  for (int count = kColumns / 2; count >= TileMeans::kTiles; count /= 2) {
    for (int i = 0; i < count; i += kLanes) {
      store(load_even(sums + 2 * i) + load_odd(sums + 2 * i), sums + i);
    }
  }
}

/// Fills the node of the means whose first pixel is (u, v).
void fill_node(const Metric& metric, const DepthSquare& square, const ObstacleTree::Node& ranges,
               float u, float v, float radius, TileMeans::Node& out) {
  TileSums sums;
  sum_columns(square, sums);
  for (float* s : {sums.count, sums.u, sums.v, sums.z_m, sums.uz_m, sums.vz_m}) add_up_columns(s);
  const BasicMetric<Lanes> m = broadcast(metric);
  const Lanes tile_px(kTilePx), half_px(kTilePx / 2.0f), half(0.5f), one(1);
  for (int i = 0; i < TileMeans::kTiles; i += kLanes) {
    const Lanes count = load(sums.count + i);
    const Lanes share = hn::Div(one.v, greatest(one, count).v);
    const Lanes z_m = load(sums.z_m + i) * share;
    const Lanes x_px = Lanes(u) + tile_px * load(kNodeGrid.column + i) - m.cx_px;
    const Lanes y_px = Lanes(v) + tile_px * load(kNodeGrid.row + i) - m.cy_px;
    store(count, out.count + i);
    store((x_px + load(sums.u + i) * share) * m.inv_fx, out.x + i);
    store((y_px + load(sums.v + i) * share) * m.inv_fy, out.y + i);
    store((x_px * z_m + load(sums.uz_m + i) * share) * m.inv_fx, out.x_m + i);
    store((y_px * z_m + load(sums.vz_m + i) * share) * m.inv_fy, out.y_m + i);
    store(z_m, out.z_m + i);
    const Lanes x = (x_px + half_px) * m.inv_fx;
    const Lanes y = (y_px + half_px) * m.inv_fy;
    const Lanes ray = hn::Sqrt((x * x + y * y + one).v);
    const Lanes lo_m = load(ranges.depth_lo_m + i);
    const Lanes hi_m = load(ranges.depth_hi_m + i);
    store(half * (hi_m - lo_m) * ray + Lanes(radius) * hi_m, out.radius_m + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(fill_node);

PixelRect nodes_within(const ObstacleTree& tree, const PixelRect& rect) {
  const auto past = [](int px) { return (px + kNodePx - 1) / kNodePx; };
  return clip({rect.u_begin / kNodePx, rect.v_begin / kNodePx, past(rect.u_end), past(rect.v_end)},
              tree.levels[0].columns, tree.levels[0].rows);
}

void build_tile_means(const Camera& camera, const SearchableDepth& obstacles, const PixelRect& rect,
                      float max_depth_m, TileMeans& out) {
  const ObstacleTree::Level& level = obstacles.tree().levels[0];
  const PixelRect nodes = nodes_within(obstacles.tree(), rect);
  const Metric metric = metric_of(camera);
  const auto fill = HWY_DYNAMIC_DISPATCH(fill_node);
  out.nodes.resize(level.nodes.size());
  out.radius = kTilePx / 2.0f * std::hypot(metric.inv_fx, metric.inv_fy);
  tbb::parallel_for(nodes.v_begin, nodes.v_end, [&](int row) {
    DepthSquareCopy<kNodePx> copy;
    for (int column = nodes.u_begin; column < nodes.u_end; ++column) {
      const int u = column * kNodePx;
      const int v = row * kNodePx;
      const int n = row * level.columns + column;
      const float* lo_m = level.nodes[n].depth_lo_m;
      if (*std::min_element(lo_m, lo_m + TileMeans::kTiles) > max_depth_m) continue;
      fill(metric, depth_square<kNodePx>(obstacles.depth_m(), u, v, copy), level.nodes[n],
           static_cast<float>(u), static_cast<float>(v), out.radius, out.nodes[n]);
    }
  });
}

}  // namespace berth
#endif  // HWY_ONCE
