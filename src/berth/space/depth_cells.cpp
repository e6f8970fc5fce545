#include "berth/space/depth_cells.hpp"

#include <algorithm>
#include <limits>

#include "berth/vector/divide_up.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/space/depth_cells.cpp"
#include "hwy/foreach_target.h"

#include "berth/space/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// Two ranges take twice the work of one: they are worth it where more than this lies between.
constexpr float kLeastGap_m = 0.06f;

struct Range {
  float lo_m = std::numeric_limits<float>::infinity();
  float hi_m = -std::numeric_limits<float>::infinity();
};

/// Writes the ranges of a cell with the range `all`. It is made of `count` parts, a multiple of
/// kLanes; NaN and [+inf, -inf] are no part.
void fill_child(const Range& all, const float* lo_m, const float* hi_m, int count,
                DepthCells::Node& node, int child) {
  Range halves[2] = {all, {}};
  if (all.hi_m - all.lo_m > kLeastGap_m) {
    const Lanes middle_m(0.5f * (all.lo_m + all.hi_m));
    const Lanes none_lo(Range{}.lo_m), none_hi(Range{}.hi_m);
    Lanes nearer_lo = none_lo, farther_lo = none_lo, nearer_hi = none_hi, farther_hi = none_hi;
    for (int i = 0; i < count; i += kLanes) {
      const Lanes lo = load(lo_m + i), hi = load(hi_m + i);
      const LaneMask is_farther = hn::Gt(lo.v, middle_m.v);
      nearer_lo = lesser_or_first(nearer_lo, hn::IfThenElse(is_farther, none_lo.v, lo.v));
      nearer_hi = greater_or_first(nearer_hi, hn::IfThenElse(is_farther, none_hi.v, hi.v));
      farther_lo = lesser_or_first(farther_lo, hn::IfThenElse(is_farther, lo.v, none_lo.v));
      farther_hi = greater_or_first(farther_hi, hn::IfThenElse(is_farther, hi.v, none_hi.v));
    }
    const Range nearer{least_lane(nearer_lo), greatest_lane(nearer_hi)};
    const Range farther{least_lane(farther_lo), greatest_lane(farther_hi)};
    if (farther.lo_m - nearer.hi_m > kLeastGap_m) {
      halves[0] = nearer;
      halves[1] = farther;
    }
  }
  for (int half = 0; half < 2; ++half) {
    node.lo_m[half][child] = halves[half].lo_m;
    node.hi_m[half][child] = halves[half].hi_m;
  }
}

/// The pixels of one cell; NaN beyond the image.
void fill_edge_cell(const DepthView& rows, int u_begin, const Range& all, DepthCells::Node& node,
                    int child) {
  constexpr int kPx = DepthCells::kCellPx;
  alignas(64) float pixels[kPx * kPx];
  std::fill_n(pixels, kPx * kPx, kNoDepth);
  const int width = std::min(kPx, rows.width - u_begin);
  for (int v = 0; v < rows.height; ++v) {
    std::copy_n(rows.row(v) + u_begin, width, pixels + v * kPx);
  }
  fill_child(all, pixels, pixels, kPx * kPx, node, child);
}

/// A row of cells from up to 8 rows of pixels; `nodes` is where the first of them lies, and
/// `first_child` its number there.
void fill_row_of_cells(const DepthView& rows, DepthCells::Node* nodes, int first_child) {
  constexpr int kPx = DepthCells::kCellPx;
  constexpr int kStrip = kPx * kLanes;
  alignas(64) float lo[kStrip], hi[kStrip], padded[kStrip];
  for (int u = 0; u < rows.width; u += kStrip) {
    std::fill_n(lo, kStrip, Range{}.lo_m);
    std::fill_n(hi, kStrip, Range{}.hi_m);
    for (int v = 0; v < rows.height; ++v) {
      const float* row = padded_row(rows.row(v) + u, rows.width - u, kStrip, padded);
      for (int i = 0; i < kStrip; i += kLanes) {
        const Lanes x = load(row + i);
        store(lesser_or_first(load(lo + i), x), lo + i);
        store(greater_or_first(load(hi + i), x), hi + i);
      }
    }
    for (int count = kStrip; count > kLanes; count /= 2) {
      halve_to_least(lo, count);
      halve_to_greatest(hi, count);
    }
    for (int i = 0; i < kLanes && u + i * kPx < rows.width; ++i) {
      const int column = u / kPx + i;
      const Range all{lo[i], hi[i]};
      DepthCells::Node& node = nodes[column / 4];
      const int child = first_child + column % 4;
      if (all.hi_m - all.lo_m > kLeastGap_m) {
        fill_edge_cell(rows, column * kPx, all, node, child);
      } else {
        fill_child(all, nullptr, nullptr, 0, node, child);
      }
    }
  }
}

/// A cell that consists of a node's children.
void fill_from_node(const DepthCells::Node& below, DepthCells::Node& node, int child) {
  constexpr int kCount = 2 * DepthCells::kChildren;
  alignas(64) float lo_m[kCount], hi_m[kCount];
  for (int half = 0; half < 2; ++half) {
    std::copy_n(below.lo_m[half], DepthCells::kChildren, lo_m + half * DepthCells::kChildren);
    std::copy_n(below.hi_m[half], DepthCells::kChildren, hi_m + half * DepthCells::kChildren);
  }
  Lanes lo(Range{}.lo_m), hi(Range{}.hi_m);
  for (int i = 0; i < kCount; i += kLanes) {
    lo = least(lo, load(lo_m + i));
    hi = greatest(hi, load(hi_m + i));
  }
  fill_child({least_lane(lo), greatest_lane(hi)}, lo_m, hi_m, kCount, node, child);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(fill_row_of_cells);
HWY_EXPORT(fill_from_node);

namespace {

void clear(DepthCells::Level& level) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (DepthCells::Node& node : level.nodes) {
    for (auto& half : node.lo_m) std::fill_n(half, DepthCells::kChildren, kInfinity);
    for (auto& half : node.hi_m) std::fill_n(half, DepthCells::kChildren, -kInfinity);
  }
}

void fill_lowest(DepthView depth_m, DepthCells::Level& level) {
  constexpr int kPx = DepthCells::kCellPx;
  for (int v = 0; v < depth_m.height; v += kPx) {
    const int row = v / kPx;
    const DepthView rows{depth_m.row(v), depth_m.width, std::min(kPx, depth_m.height - v),
                         depth_m.stride};
    HWY_DYNAMIC_DISPATCH(fill_row_of_cells)
    (rows, level.nodes.data() + row / 4 * level.node_columns, row % 4 * 4);
  }
}

void fill_level(const DepthCells::Level& children, DepthCells::Level& level) {
  for (int row = 0; row < children.node_rows; ++row) {
    for (int column = 0; column < children.node_columns; ++column) {
      HWY_DYNAMIC_DISPATCH(fill_from_node)
      (children.nodes[row * children.node_columns + column],
       level.nodes[(row / 4) * level.node_columns + column / 4], row % 4 * 4 + column % 4);
    }
  }
}

}  // namespace

void build_depth_cells(DepthView depth_m, DepthCells& cells) {
  cells.level_count = 0;
  int cell_px = DepthCells::kCellPx;
  bool is_root = false;
  while (!is_root) {
    if (static_cast<int>(cells.levels.size()) == cells.level_count) cells.levels.emplace_back();
    DepthCells::Level& level = cells.levels[cells.level_count++];
    level.cell_px = cell_px;
    level.node_columns = std::max(1, divide_up(depth_m.width, 4 * cell_px));
    level.node_rows = std::max(1, divide_up(depth_m.height, 4 * cell_px));
    level.nodes.resize(static_cast<std::size_t>(level.node_columns) * level.node_rows);
    clear(level);
    is_root = level.nodes.size() == 1;
    cell_px *= 4;
  }
  fill_lowest(depth_m, cells.levels[0]);
  for (int i = 1; i < cells.level_count; ++i) fill_level(cells.levels[i - 1], cells.levels[i]);
}

}  // namespace berth
#endif  // HWY_ONCE
