#include "thesis/obstacle_tree.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "berth/vector/divide_up.hpp"
#include "thesis/depth_tile.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "thesis/obstacle_tree.cpp"
#include "hwy/foreach_target.h"

#include "berth/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

constexpr int kChildren = ObstacleTree::kChildren;

/// The depth range of each column of 8 pixels, in a node's 4 rows of tiles.
struct ColumnRanges {
  alignas(64) float lo_m[4 * kNodePx];
  alignas(64) float hi_m[4 * kNodePx];
};

HWY_INLINE void take_columns(const float* depth_m, std::ptrdiff_t stride, ColumnRanges& out) {
  for (int i = 0; i < 4 * kNodePx; i += kLanes) {
    const float* column_m = depth_m + (i / kNodePx) * kTilePx * stride + i % kNodePx;
    Lanes lo_m(HUGE_VALF);
    Lanes hi_m(-HUGE_VALF);
    for (int v = 0; v < kTilePx; ++v) {
      const Lanes x = load(column_m + v * stride);
      lo_m = lesser_or_first(lo_m, x);
      hi_m = greater_or_first(hi_m, x);
    }
    store(lo_m, out.lo_m + i);
    store(hi_m, out.hi_m + i);
  }
}

/// Replaces 2 n numbers by the lesser, or greater, of each two neighbours.
template <bool lesser>
HWY_INLINE void halve(int n, const float* x, float* out) {
  for (int i = 0; i < n; i += kLanes) {
    const Lanes even = load_even(x + 2 * i);
    const Lanes odd = load_odd(x + 2 * i);
    store(lesser ? least(even, odd) : greatest(even, odd), out + i);
  }
}

template <bool lesser>
HWY_INLINE void reduce_tiles(const float* columns_m, float* tiles_m) {
  alignas(64) float half_m[2 * kNodePx];
  alignas(64) float quarter_m[kNodePx];
  halve<lesser>(2 * kNodePx, columns_m, half_m);
  halve<lesser>(kNodePx, half_m, quarter_m);
  halve<lesser>(kChildren, quarter_m, tiles_m);
}

/// One node of 32 x 32 pixels.
void fill_tiles(const DepthSquare& square, ObstacleTree::Node& node) {
  ColumnRanges columns;
  take_columns(square.depth_m, square.stride, columns);
  reduce_tiles<true>(columns.lo_m, node.depth_lo_m);
  reduce_tiles<false>(columns.hi_m, node.depth_hi_m);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(fill_tiles);

namespace {

void size_levels(DepthView depth_m, ObstacleTree& tree) {
  tree.width = depth_m.width;
  tree.height = depth_m.height;
  tree.level_count = 0;
  int child_px = kTilePx;
  ObstacleTree::Level* level = nullptr;
  do {
    if (static_cast<int>(tree.levels.size()) == tree.level_count) tree.levels.emplace_back();
    level = &tree.levels[tree.level_count++];
    level->child_px = child_px;
    level->columns = std::max(1, divide_up(depth_m.width, 4 * child_px));
    level->rows = std::max(1, divide_up(depth_m.height, 4 * child_px));
    level->nodes.resize(static_cast<std::size_t>(level->columns) * level->rows);
    child_px *= 4;
  } while (level->nodes.size() > 1);
}

void fill_row(DepthView depth_m, int row, ObstacleTree::Level& level) {
  const auto fill = HWY_DYNAMIC_DISPATCH(fill_tiles);
  DepthSquareCopy<kNodePx> copy;
  for (int column = 0; column < level.columns; ++column) {
    fill(depth_square<kNodePx>(depth_m, column * kNodePx, row * kNodePx, copy),
         level.nodes[static_cast<std::size_t>(row) * level.columns + column]);
  }
}

void fill_lowest_level(DepthView depth_m, ObstacleTree::Level& level) {
  constexpr int kRowsAtOnce = 4;
  tbb::parallel_for(tbb::blocked_range<int>(0, level.rows, kRowsAtOnce),
                    [&](const tbb::blocked_range<int>& rows) {
                      for (int row = rows.begin(); row < rows.end(); ++row) {
                        fill_row(depth_m, row, level);
                      }
                    });
}

void fill_level(const ObstacleTree::Level& children, ObstacleTree::Level& level) {
  for (ObstacleTree::Node& node : level.nodes) {
    std::fill_n(node.depth_lo_m, ObstacleTree::kChildren, HUGE_VALF);
    std::fill_n(node.depth_hi_m, ObstacleTree::kChildren, -HUGE_VALF);
  }
  for (int row = 0; row < children.rows; ++row) {
    for (int column = 0; column < children.columns; ++column) {
      const ObstacleTree::Node& child = children.nodes[row * children.columns + column];
      ObstacleTree::Node& node = level.nodes[(row / 4) * level.columns + column / 4];
      const int c = (row % 4) * 4 + column % 4;
      node.depth_lo_m[c] = *std::min_element(child.depth_lo_m, child.depth_lo_m + 16);
      node.depth_hi_m[c] = *std::max_element(child.depth_hi_m, child.depth_hi_m + 16);
    }
  }
}

}  // namespace

void build_obstacle_tree(DepthView depth_m, ObstacleTree& tree) {
  size_levels(depth_m, tree);
  fill_lowest_level(depth_m, tree.levels[0]);
  for (int i = 1; i < tree.level_count; ++i) fill_level(tree.levels[i - 1], tree.levels[i]);
}

}  // namespace berth
#endif  // HWY_ONCE
