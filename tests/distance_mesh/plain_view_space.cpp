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

namespace {




/// Least and greatest of each 4 x 4 pixels.
void fill_blocks(DepthView image, int columns, int rows, DepthWindows& windows) {
  const std::size_t count = static_cast<std::size_t>(columns) * rows;
  windows.least_of_blocks.assign(count, kInfinity);
  windows.greatest_of_blocks.assign(count, -kInfinity);
  for (int v = 0; v < image.height; ++v) {
    const float* row = image.row(v);
    float* least = windows.least_of_blocks.data() + v / DepthWindows::kFirstStepPx * columns;
    float* greatest = windows.greatest_of_blocks.data() + v / DepthWindows::kFirstStepPx * columns;
    for (int u = 0; u < image.width; ++u) {
      const float x = std::isnan(row[u]) ? kInfinity : row[u];
      const int block = u / DepthWindows::kFirstStepPx;
      least[block] = std::min(least[block], x);
      greatest[block] = std::max(greatest[block], x);
    }
  }
}

/// Each window from the 2 x 2 blocks of its own step that begin with it.
void fill_windows(const DepthWindows& windows, DepthWindows::Level& level) {
  const float* least = windows.least_of_blocks.data();
  const float* greatest = windows.greatest_of_blocks.data();
  for (int j = 0; j < level.rows; ++j) {
    const int below = std::min(j + 1, level.rows - 1);
    for (int i = 0; i < level.columns; ++i) {
      const int right = std::min(i + 1, level.columns - 1);
      const int blocks[] = {j * level.columns + i, j * level.columns + right,
                            below * level.columns + i, below * level.columns + right};
      float lo = kInfinity;
      float hi = -kInfinity;
      for (const int b : blocks) {
        lo = std::min(lo, least[b]);
        hi = std::max(hi, greatest[b]);
      }
      level.least[j * level.columns + i] = lo;
      level.greatest[j * level.columns + i] = hi;
    }
  }
}

/// A block of twice the size is the window that begins with it.
void double_blocks(const DepthWindows::Level& level, int columns, int rows, DepthWindows& windows) {
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      windows.least_of_blocks[j * columns + i] = level.least[2 * j * level.columns + 2 * i];
      windows.greatest_of_blocks[j * columns + i] = level.greatest[2 * j * level.columns + 2 * i];
    }
  }
}

}  // namespace

void plain_depth_windows(DepthView image, DepthWindows& windows) {
  windows.level_count = 0;
  int step_px = DepthWindows::kFirstStepPx;
  for (bool is_last = false; !is_last; step_px *= 2) {
    if (static_cast<int>(windows.levels.size()) == windows.level_count) {
      windows.levels.emplace_back();
    }
    DepthWindows::Level& level = windows.levels[windows.level_count++];
    level.step_px = step_px;
    level.columns = divide_up(image.width, step_px);
    level.rows = divide_up(image.height, step_px);
    if (windows.level_count == 1) {
      fill_blocks(image, level.columns, level.rows, windows);
    } else {
      double_blocks(windows.levels[windows.level_count - 2], level.columns, level.rows, windows);
    }
    level.least.resize(static_cast<std::size_t>(level.columns) * level.rows);
    level.greatest.resize(static_cast<std::size_t>(level.columns) * level.rows);
    fill_windows(windows, level);
    is_last = level.columns == 1 && level.rows == 1;
  }
}

}  // namespace berth::testing
