#include "berth/distance/mesh/depth_windows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berth {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

int divide_up(int a, int b) { return (a + b - 1) / b; }

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

void build_depth_windows(DepthView image, DepthWindows& windows) {
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

}  // namespace berth
