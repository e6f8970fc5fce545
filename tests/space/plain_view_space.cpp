#include "tests/space/plain_view_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/plain_closing.hpp"

namespace berth::testing {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Calls action(x, y) for each pixel of the rectangle that the image has.
template <class Action>
void for_pixels(const DepthView& image, PixelRect rect, Action action) {
  for (int y = rect.v_begin; y < rect.v_end; ++y) {
    for (int x = rect.u_begin; x < rect.u_end; ++x) {
      if (x >= 0 && y >= 0 && x < image.width && y < image.height) action(x, y);
    }
  }
}

PixelRect three_by_three(int u, int v) { return {u - 1, v - 1, u + 2, v + 2}; }

/// Definition 1 for a pixel that the sensor or the filter has something of. May be NaN.
float freed_by_reading(float sensed_m, float kept_m, float environment_back_m, PixelFate fate,
                       const SpaceSettings& settings) {
  const float to_robot_m = sensed_m + static_cast<float>(settings.behind_robot_m);
  const auto margin_m = static_cast<float>(settings.free_space_margin_m);
  if (fate == PixelFate::background) {
    return std::isnan(sensed_m) ? 0 : std::min(kept_m - margin_m, to_robot_m);
  }
  if (is_kept(fate) || fate == PixelFate::no_reading) return kept_m - margin_m;
  const float before_m = sensed_m - margin_m;
  if (fate == PixelFate::environment && environment_back_m > before_m) {
    return environment_back_m < to_robot_m ? environment_back_m : to_robot_m;
  }
  const bool is_robot = fate == PixelFate::robot || fate == PixelFate::padding;
  return is_robot ? to_robot_m : before_m;
}

/// Where the two nearer and farther ranges of a cell lie, from its readings or its parts' ranges.
using Range = std::pair<float, float>;
std::pair<Range, Range> nearer_and_farther(const std::vector<Range>& parts) {
  constexpr float kLeastGap_m = 0.06f;
  constexpr Range kNone{kInfinity, -kInfinity};
  const auto joined = [](const Range& a, const Range& b) {
    return Range{std::min(a.first, b.first), std::max(a.second, b.second)};
  };
  Range all = kNone, near = kNone, far = kNone;
  for (const Range& part : parts) all = joined(all, part);
  const float middle_m = 0.5f * (all.first + all.second);
  for (const Range& part : parts) {
    Range& half = part.first > middle_m ? far : near;
    half = joined(half, part);
  }
  if (far.first - near.second > kLeastGap_m) return {near, far};
  return {all, kNone};
}

/// The readings of a cell of 8 x 8 pixels.
std::vector<Range> readings_of(DepthView depth_m, int column, int row) {
  constexpr int kSide = DepthCells::kCellPx;
  std::vector<Range> parts;
  for_pixels(depth_m, {column * kSide, row * kSide, (column + 1) * kSide, (row + 1) * kSide},
             [&](int u, int v) {
               if (!std::isnan(depth_m(u, v))) parts.emplace_back(depth_m(u, v), depth_m(u, v));
             });
  return parts;
}

/// The ranges of the 4 x 4 cells that a cell one level up is made of.
std::vector<Range> ranges_of(const DepthCells::Level& level, int column, int row) {
  std::vector<Range> parts;
  if (column >= level.node_columns || row >= level.node_rows) return parts;
  const DepthCells::Node& node = level.nodes[row * level.node_columns + column];
  for (int half = 0; half < 2; ++half) {
    for (int i = 0; i < DepthCells::kChildren; ++i) {
      const Range range{node.lo_m[half][i], node.hi_m[half][i]};
      if (range.first <= range.second) parts.push_back(range);
    }
  }
  return parts;
}

/// A depth in metres as the windows count it.
std::uint16_t count_of(float depth_m) {
  if (depth_m == kInfinity) return 65535;
  return static_cast<std::uint16_t>(std::max(0.0f, 2048 * sim::plainly_counted(depth_m)));
}

int blocks(int pixels, int side_px) {
  return static_cast<int>(std::ceil(static_cast<double>(pixels) / side_px));
}

}  // namespace

void plain_own_free_depth(DepthView sensor_depth_m, const ObstacleImage& obstacles,
                          DepthView environment_back_m, const SpaceSettings& settings,
                          DepthImage& out) {
  const auto is_empty = [&](int u, int v) {
    if (obstacles.fate(u, v) == PixelFate::hole) return true;
    return std::isnan(sensor_depth_m(u, v)) && std::isnan(obstacles.depth_m(u, v));
  };
  const auto freed_at = [&](int u, int v) {
    return freed_by_reading(sensor_depth_m(u, v), obstacles.depth_m(u, v), environment_back_m(u, v),
                            obstacles.fate(u, v), settings);
  };
  out = DepthImage(sensor_depth_m.width, sensor_depth_m.height, 0);
  for (int v = 0; v < out.height(); ++v) {
    for (int u = 0; u < out.width(); ++u) {
      float own_m = 0;
      if (!is_empty(u, v)) {
        own_m = freed_at(u, v);
      } else {
        own_m = settings.no_reading == NoReading::free ? kInfinity : 0;
      }
      if (own_m > 0) out(u, v) = sim::plainly_counted(own_m);
    }
  }
}

void plain_free_depth_of(const DepthImage& own_m, DepthImage& out) {
  out = DepthImage(own_m.width(), own_m.height(), 0);
  for (int v = 1; v < own_m.height() - 1; ++v) {
    for (int u = 1; u < own_m.width() - 1; ++u) {
      out(u, v) = own_m(u, v);
      for_pixels(own_m, three_by_three(u, v),
                 [&](int x, int y) { out(u, v) = std::min(out(u, v), own_m(x, y)); });
    }
  }
}

void plain_depth_cells(DepthView depth_m, DepthCells& cells) {
  cells = {};
  do {
    DepthCells::Level level;
    const bool is_lowest = cells.levels.empty();
    level.cell_px = is_lowest ? DepthCells::kCellPx : 4 * cells.levels.back().cell_px;
    level.node_columns = blocks(depth_m.width, 4 * level.cell_px);
    level.node_rows = blocks(depth_m.height, 4 * level.cell_px);
    level.nodes.resize(static_cast<std::size_t>(level.node_columns) * level.node_rows);
    for (int row = 0; row < 4 * level.node_rows; ++row) {
      for (int column = 0; column < 4 * level.node_columns; ++column) {
        DepthCells::Node& node = level.nodes[row / 4 * level.node_columns + column / 4];
        const int child = row % 4 * 4 + column % 4;
        const auto [near, far] =
            nearer_and_farther(is_lowest ? readings_of(depth_m, column, row)
                                         : ranges_of(cells.levels.back(), column, row));
        std::tie(node.lo_m[0][child], node.hi_m[0][child]) = near;
        std::tie(node.lo_m[1][child], node.hi_m[1][child]) = far;
      }
    }
    cells.levels.push_back(std::move(level));
  } while (cells.levels.back().nodes.size() > 1);
  cells.level_count = static_cast<int>(cells.levels.size());
}

void plain_depth_windows(DepthView image, DepthWindows& windows) {
  windows = {};
  do {
    DepthWindows::Level level;
    level.side_px = windows.levels.empty() ? 1 : 2 * windows.levels.back().side_px;
    level.step_px = level.side_px == 1 ? 1 : std::max(2, level.side_px / 4);
    level.columns = blocks(image.width, level.step_px);
    level.rows = blocks(image.height, level.step_px);
    for (int v = 0; v < image.height; v += level.step_px) {
      for (int u = 0; u < image.width; u += level.step_px) {
        float least_m = kInfinity;
        for_pixels(image, {u, v, u + level.side_px, v + level.side_px}, [&](int x, int y) {
          if (image(x, y) < least_m) least_m = image(x, y);
        });
        level.least.push_back(count_of(least_m));
      }
    }
    windows.levels.push_back(std::move(level));
  } while (windows.levels.back().side_px < std::max({4, image.width, image.height}));
  windows.level_count = static_cast<int>(windows.levels.size());
}

}  // namespace berth::testing
