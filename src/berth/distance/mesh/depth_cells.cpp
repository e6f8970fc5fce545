#include "berth/distance/mesh/depth_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berth {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Two ranges take twice the work of one: they are worth it where more than this lies between.
constexpr float kLeastGap_m = 0.06f;

struct Range {
  float lo_m = kInfinity;
  float hi_m = -kInfinity;
  void add(float lo, float hi) {
    lo_m = std::min(lo_m, lo);
    hi_m = std::max(hi_m, hi);
  }
};

int divide_up(int a, int b) { return (a + b - 1) / b; }

/// Calls action(lo, hi) for what a cell is made of, twice: to find the middle of all, then to part
/// nearer and farther.
template <class ForParts>
void fill_child(ForParts for_parts, DepthCells::Node& node, int child) {
  Range all;
  for_parts([&](float lo, float hi) { all.add(lo, hi); });
  Range halves[2];
  const float middle_m = 0.5f * (all.lo_m + all.hi_m);
  for_parts([&](float lo, float hi) { halves[lo > middle_m].add(lo, hi); });
  if (!(halves[1].lo_m - halves[0].hi_m > kLeastGap_m)) {
    halves[0] = all;
    halves[1] = Range{};
  }
  for (int half = 0; half < 2; ++half) {
    node.lo_m[half][child] = halves[half].lo_m;
    node.hi_m[half][child] = halves[half].hi_m;
  }
}

void fill_lowest(DepthView depth_m, DepthCells::Level& level) {
  for (int row = 0; row < 4 * level.node_rows; ++row) {
    for (int column = 0; column < 4 * level.node_columns; ++column) {
      DepthCells::Node& node = level.nodes[(row / 4) * level.node_columns + column / 4];
      const PixelRect rect =
          clip({column * DepthCells::kCellPx, row * DepthCells::kCellPx,
                (column + 1) * DepthCells::kCellPx, (row + 1) * DepthCells::kCellPx},
               depth_m.width, depth_m.height);
      const auto for_pixels = [&](auto action) {
        for (int v = rect.v_begin; v < rect.v_end; ++v) {
          for (int u = rect.u_begin; u < rect.u_end; ++u) {
            const float m = depth_m(u, v);
            if (!std::isnan(m)) action(m, m);
          }
        }
      };
      fill_child(for_pixels, node, row % 4 * 4 + column % 4);
    }
  }
}

void fill_level(const DepthCells::Level& children, DepthCells::Level& level) {
  for (int row = 0; row < 4 * level.node_rows; ++row) {
    for (int column = 0; column < 4 * level.node_columns; ++column) {
      DepthCells::Node& node = level.nodes[(row / 4) * level.node_columns + column / 4];
      const bool exists = row < children.node_rows && column < children.node_columns;
      const DepthCells::Node* below =
          exists ? &children.nodes[row * children.node_columns + column] : nullptr;
      const auto for_cells = [&](auto action) {
        if (below == nullptr) return;
        for (int half = 0; half < 2; ++half) {
          for (int i = 0; i < DepthCells::kChildren; ++i) {
            if (below->lo_m[half][i] <= below->hi_m[half][i]) {
              action(below->lo_m[half][i], below->hi_m[half][i]);
            }
          }
        }
      };
      fill_child(for_cells, node, row % 4 * 4 + column % 4);
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
    is_root = level.nodes.size() == 1;
    cell_px *= 4;
  }
  fill_lowest(depth_m, cells.levels[0]);
  for (int i = 1; i < cells.level_count; ++i) fill_level(cells.levels[i - 1], cells.levels[i]);
}

}  // namespace berth
