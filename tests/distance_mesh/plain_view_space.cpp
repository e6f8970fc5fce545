#include "tests/distance_mesh/plain_view_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berth::testing {
namespace {

constexpr float kEndless = std::numeric_limits<float>::max();

bool has_nothing(float sensed_m, float obstacle_m) {
  return std::isnan(sensed_m) && std::isnan(obstacle_m);
}

float own_of_reading(float sensed_m, float obstacle_m, PixelFate fate, float margin_m,
                     float behind_m) {
  switch (fate) {
    case PixelFate::background:
      return std::isnan(sensed_m) ? 0 : std::min(obstacle_m - margin_m, sensed_m + behind_m);
    case PixelFate::robot:
    case PixelFate::environment:
    case PixelFate::padding:
    case PixelFate::dilation:
      return sensed_m + behind_m;
    case PixelFate::edge:
    case PixelFate::island:
    case PixelFate::speckle:
    case PixelFate::outside_region:
      return sensed_m - margin_m;
    case PixelFate::obstacle:
    case PixelFate::no_reading:
    case PixelFate::averaged:
    case PixelFate::hole:
      break;
  }
  return obstacle_m - margin_m;
}

float own_of_hole(DepthView sensor_depth_m, const ObstacleImage& obstacles, int u, int v,
                  float margin_m, float behind_m) {
  constexpr int kLeastNeighbours = 5;
  int readings = 0;
  float least_m = kEndless;
  const PixelRect around =
      clip({u - 1, v - 1, u + 2, v + 2}, sensor_depth_m.width, sensor_depth_m.height);
  for (int y = around.v_begin; y < around.v_end; ++y) {
    for (int x = around.u_begin; x < around.u_end; ++x) {
      const float sensed_m = sensor_depth_m(x, y);
      if (std::isnan(sensed_m)) continue;
      ++readings;
      least_m = std::min(least_m, own_of_reading(sensed_m, obstacles.depth_m(x, y),
                                                 obstacles.fate(x, y), margin_m, behind_m));
    }
  }
  return readings >= kLeastNeighbours ? least_m : 0;
}

}  // namespace

void plain_own_free_depth(DepthView sensor_depth_m, const ObstacleImage& obstacles,
                          const SpaceSettings& settings, DepthImage& out) {
  const auto margin_m = static_cast<float>(settings.carve_margin_m);
  const auto behind_m = static_cast<float>(settings.behind_robot_m);
  out.resize(sensor_depth_m.width, sensor_depth_m.height, 0);
  for (int v = 0; v < sensor_depth_m.height; ++v) {
    for (int u = 0; u < sensor_depth_m.width; ++u) {
      const float sensed_m = sensor_depth_m(u, v);
      const float obstacle_m = obstacles.depth_m(u, v);
      float own_m;
      if (!has_nothing(sensed_m, obstacle_m)) {
        own_m = own_of_reading(sensed_m, obstacle_m, obstacles.fate(u, v), margin_m, behind_m);
      } else if (settings.no_reading == NoReading::free) {
        own_m = kEndless;
      } else {
        own_m = own_of_hole(sensor_depth_m, obstacles, u, v, margin_m, behind_m);
      }
      out(u, v) = own_m > 0 ? own_m : 0;
    }
  }
}

void plain_free_depth_of(const DepthImage& own_m, DepthImage& out) {
  out.resize(own_m.width(), own_m.height(), 0);
  for (int v = 1; v + 1 < own_m.height(); ++v) {
    for (int u = 1; u + 1 < own_m.width(); ++u) {
      float least_m = kEndless;
      for (int y = v - 1; y <= v + 1; ++y) {
        for (int x = u - 1; x <= u + 1; ++x) least_m = std::min(least_m, own_m(x, y));
      }
      out(u, v) = least_m;
    }
  }
}

namespace {

constexpr float kFar_m = std::numeric_limits<float>::infinity();
/// Two ranges take twice the work of one: they are worth it where more than this lies between.
constexpr float kLeastGap_m = 0.06f;

struct Range {
  float lo_m = kFar_m;
  float hi_m = -kFar_m;
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

void plain_depth_cells(DepthView depth_m, DepthCells& cells) {
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

void plain_depth_windows(DepthView image, DepthWindows& windows) {
  windows.level_count = 0;
  for (int side_px = 4;; side_px *= 2) {
    const int n = windows.level_count++;
    windows.levels.resize(std::max<std::size_t>(windows.levels.size(), n + 1));
    DepthWindows::Level& level = windows.levels[n];
    level.side_px = side_px;
    level.step_px = side_px == 4 ? 2 : side_px / 4;
    level.columns = divide_up(image.width, level.step_px);
    level.rows = divide_up(image.height, level.step_px);
    level.least.assign(static_cast<std::size_t>(level.columns) * level.rows, kFar_m);
    for (int j = 0; j < level.rows; ++j) {
      for (int i = 0; i < level.columns; ++i) {
        float& least = level.least[j * level.columns + i];
        const PixelRect pixels = clip({i * level.step_px, j * level.step_px,
                                       i * level.step_px + side_px, j * level.step_px + side_px},
                                      image.width, image.height);
        for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
          for (int u = pixels.u_begin; u < pixels.u_end; ++u) {
            if (!std::isnan(image(u, v))) least = std::min(least, image(u, v));
          }
        }
      }
    }
    if (side_px >= std::max(image.width, image.height)) return;
  }
}

}  // namespace berth::testing
