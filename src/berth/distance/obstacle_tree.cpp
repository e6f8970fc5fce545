#include "berth/distance/obstacle_tree.hpp"

#include <algorithm>
#include <cmath>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/obstacle_tree.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kTilePx = ObstacleTree::kTilePx;
constexpr int kTilePixels = ObstacleTree::kTilePixels;
constexpr int kChildren = ObstacleTree::kChildren;

/// Copies tile c of a node and takes its depth range. A NaN fails both comparisons.
HWY_INLINE void fill_tile(const float* depth_m, std::ptrdiff_t stride, int c, float* tile_m,
                          ObstacleTree::Node& node) {
  const hn::CappedTag<float, kTilePx> d;
  constexpr int kStep = static_cast<int>(hn::MaxLanes(d));
  auto lo_m = hn::Set(d, HUGE_VALF);
  auto hi_m = hn::Set(d, -HUGE_VALF);
  for (int v = 0; v < kTilePx; ++v) {
    for (int u = 0; u < kTilePx; u += kStep) {
      const auto x = hn::LoadU(d, depth_m + v * stride + u);
      hn::StoreU(x, d, tile_m + v * kTilePx + u);
      lo_m = hn::IfThenElse(hn::Lt(x, lo_m), x, lo_m);
      hi_m = hn::IfThenElse(hn::Gt(x, hi_m), x, hi_m);
    }
  }
  node.depth_lo_m[c] = hn::GetLane(hn::MinOfLanes(d, lo_m));
  node.depth_hi_m[c] = hn::GetLane(hn::MaxOfLanes(d, hi_m));
}

/// One node of 32 x 32 pixels, all of which can be read.
void fill_tiles(const float* depth_m, std::ptrdiff_t stride, float* tiles_m,
                ObstacleTree::Node& node) {
  for (int c = 0; c < kChildren; ++c) {
    fill_tile(depth_m + (c / 4) * kTilePx * stride + (c % 4) * kTilePx, stride, c,
              tiles_m + c * kTilePixels, node);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(fill_tiles);

namespace {

constexpr int kNodePx = 4 * ObstacleTree::kTilePx;

int divide_up(int a, int b) { return (a + b - 1) / b; }

void size_levels(DepthView depth_m, ObstacleTree& tree) {
  tree.width = depth_m.width;
  tree.height = depth_m.height;
  tree.level_count = 0;
  int child_px = ObstacleTree::kTilePx;
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
  tree.tile_depth_m.resize(tree.levels[0].nodes.size() * ObstacleTree::kChildren *
                           ObstacleTree::kTilePixels);
}

/// Fills a node that the image's border cuts, from a copy with NaN beyond the border.
void fill_border_node(DepthView depth_m, int u_begin, int v_begin, float* tiles_m,
                      ObstacleTree::Node& node) {
  float padded_m[kNodePx * kNodePx];
  std::fill_n(padded_m, kNodePx * kNodePx, kNoDepth);
  const int width = std::min(kNodePx, depth_m.width - u_begin);
  const int height = std::min(kNodePx, depth_m.height - v_begin);
  for (int v = 0; v < height; ++v) {
    std::copy_n(depth_m.row(v_begin + v) + u_begin, width, padded_m + v * kNodePx);
  }
  HWY_DYNAMIC_DISPATCH(fill_tiles)(padded_m, kNodePx, tiles_m, node);
}

void fill_lowest_level(DepthView depth_m, ObstacleTree& tree) {
  ObstacleTree::Level& level = tree.levels[0];
  const auto fill_inner_node = HWY_DYNAMIC_DISPATCH(fill_tiles);
  float* tiles_m = tree.tile_depth_m.data();
  ObstacleTree::Node* node = level.nodes.data();
  for (int v = 0; v < level.rows * kNodePx; v += kNodePx) {
    for (int u = 0; u < level.columns * kNodePx; u += kNodePx) {
      if (u + kNodePx <= depth_m.width && v + kNodePx <= depth_m.height) {
        fill_inner_node(depth_m.row(v) + u, depth_m.stride, tiles_m, *node);
      } else {
        fill_border_node(depth_m, u, v, tiles_m, *node);
      }
      tiles_m += ObstacleTree::kChildren * ObstacleTree::kTilePixels;
      ++node;
    }
  }
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
  fill_lowest_level(depth_m, tree);
  for (int i = 1; i < tree.level_count; ++i) fill_level(tree.levels[i - 1], tree.levels[i]);
}

}  // namespace berth
#endif  // HWY_ONCE
