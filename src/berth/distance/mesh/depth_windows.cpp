#include "berth/distance/mesh/depth_windows.hpp"

#include <algorithm>
#include <limits>

#include "berth/vector/divide_up.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/mesh/depth_windows.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/mesh/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// Least and greatest of each 4 x 4 pixels of a few rows; a NaN counts as +inf.
void fill_row_of_blocks(const DepthView& rows, float* least_of, float* greatest_of) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr int kPx = DepthWindows::kFirstStepPx;
  constexpr int kStrip = kPx * kLanes;
  alignas(64) float lo[kStrip], hi[kStrip], padded[kStrip];
  for (int u = 0; u < rows.width; u += kStrip) {
    std::fill_n(lo, kStrip, kInfinity);
    std::fill_n(hi, kStrip, -kInfinity);
    for (int v = 0; v < rows.height; ++v) {
      const float* row = padded_row(rows.row(v) + u, rows.width - u, kStrip, padded);
      for (int i = 0; i < kStrip; i += kLanes) {
        const auto read = load(row + i).v;
        const Lanes x = hn::IfThenElse(hn::Eq(read, read), read, Lanes(kInfinity).v);
        store(least(load(lo + i), x), lo + i);
        store(greatest(load(hi + i), x), hi + i);
      }
    }
    for (int count = kStrip; count > kLanes; count /= 2) {
      halve_to_least(lo, count);
      halve_to_greatest(hi, count);
    }
    const int blocks = std::min(kLanes, (rows.width - u + kPx - 1) / kPx);
    std::copy_n(lo, blocks, least_of + u / kPx);
    std::copy_n(hi, blocks, greatest_of + u / kPx);
  }
}

/// Windows of one row from two rows of blocks.
void fill_row_of_least(const float* above, const float* below, int columns, float* out) {
  const auto one = [&](int i, int right) {
    return std::min({above[i], above[right], below[i], below[right]});
  };
  for_row(
      0, columns - 1,
      [&](int i) {
        store(least(least(load(above + i), load(above + i + 1)),
                    least(load(below + i), load(below + i + 1))),
              out + i);
      },
      [&](int i) { out[i] = one(i, i + 1); });
  out[columns - 1] = one(columns - 1, columns - 1);
}

void fill_row_of_greatest(const float* above, const float* below, int columns, float* out) {
  const auto one = [&](int i, int right) {
    return std::max({above[i], above[right], below[i], below[right]});
  };
  for_row(
      0, columns - 1,
      [&](int i) {
        store(greatest(greatest(load(above + i), load(above + i + 1)),
                       greatest(load(below + i), load(below + i + 1))),
              out + i);
      },
      [&](int i) { out[i] = one(i, i + 1); });
  out[columns - 1] = one(columns - 1, columns - 1);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(fill_row_of_blocks);
HWY_EXPORT(fill_row_of_least);
HWY_EXPORT(fill_row_of_greatest);

namespace {

/// Least and greatest of each 4 x 4 pixels.
void fill_blocks(DepthView image, int columns, int rows, DepthWindows& windows) {
  constexpr int kPx = DepthWindows::kFirstStepPx;
  const std::size_t count = static_cast<std::size_t>(columns) * rows;
  windows.least_of_blocks.resize(count);
  windows.greatest_of_blocks.resize(count);
  for (int j = 0; j < rows; ++j) {
    const DepthView part{image.row(j * kPx), image.width, std::min(kPx, image.height - j * kPx),
                         image.stride};
    HWY_DYNAMIC_DISPATCH(fill_row_of_blocks)
    (part, windows.least_of_blocks.data() + j * columns,
     windows.greatest_of_blocks.data() + j * columns);
  }
}

/// Each window from the 2 x 2 blocks of its own step that begin with it.
void fill_windows(const DepthWindows& windows, DepthWindows::Level& level) {
  for (int j = 0; j < level.rows; ++j) {
    const int first = j * level.columns;
    const int below = std::min(j + 1, level.rows - 1) * level.columns;
    const float* least = windows.least_of_blocks.data();
    const float* greatest = windows.greatest_of_blocks.data();
    HWY_DYNAMIC_DISPATCH(fill_row_of_least)
    (least + first, least + below, level.columns, level.least.data() + first);
    HWY_DYNAMIC_DISPATCH(fill_row_of_greatest)
    (greatest + first, greatest + below, level.columns, level.greatest.data() + first);
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
#endif  // HWY_ONCE
