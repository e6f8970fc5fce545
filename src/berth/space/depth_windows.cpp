#include "berth/space/depth_windows.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "berth/vector/divide_up.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/space/depth_windows.cpp"
#include "hwy/foreach_target.h"

#include "berth/space/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// The least of each number and the one `ahead` of it, of both rows; the last one stands for those
/// beyond.
void fill_row_of_least(const DepthUnits* above, const DepthUnits* below, int columns, int ahead,
                       DepthUnits* out) {
  const int whole = std::max(0, columns - ahead);
  for_row<kShorts>(
      0, whole,
      [&](int i) {
        const auto here = hn::Min(load_shorts(above + i), load_shorts(below + i));
        const auto next = hn::Min(load_shorts(above + i + ahead), load_shorts(below + i + ahead));
        store_shorts(hn::Min(here, next), out + i);
      },
      [&](int i) {
        out[i] = std::min({above[i], above[i + ahead], below[i], below[i + ahead]});
      });
  DepthUnits all = kEndlessUnits;
  for (int i = columns - 1; i >= whole; --i) {
    all = std::min({all, above[i], below[i]});
    out[i] = all;
  }
}

/// Every second number. Such loops are the compiler's to make vectors of.
void fill_every_second(const DepthUnits* from, int count, DepthUnits* HWY_RESTRICT out) {
  for (int i = 0; i < count; ++i) out[i] = from[2 * i];
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(fill_row_of_least);
HWY_EXPORT(fill_every_second);

namespace {

void set_size(int columns, int rows, DepthWindows::Level& level) {
  level.columns = columns;
  level.rows = rows;
  level.least.resize(static_cast<std::size_t>(columns) * rows + 1);
}

/// Windows twice as large as those of the level below.
void fill_level(const DepthWindows::Level& below, std::vector<DepthUnits>& row,
                DepthWindows::Level& level) {
  level.side_px = 2 * below.side_px;
  level.step_px = std::max(2, level.side_px / 4);
  const int ahead = below.side_px / below.step_px;
  const int every = level.step_px / below.step_px;
  set_size(divide_up(below.columns, every), divide_up(below.rows, every), level);
  row.resize(below.columns);
  for (int j = 0; j < level.rows; ++j) {
    HWY_DYNAMIC_DISPATCH(fill_row_of_least)
    (below.row(every * j), below.row(std::min(every * j + ahead, below.rows - 1)), below.columns,
     ahead, every == 1 ? level.row(j) : row.data());
    if (every == 2) {
      HWY_DYNAMIC_DISPATCH(fill_every_second)(row.data(), level.columns, level.row(j));
    }
  }
}

/// The first window from the first pixel on or before, and the first that ends at the last pixel
/// or behind.
std::array<int, 2> windows_of(const DepthWindows::Level& level, int begin, int end) {
  // Requests ask often: a step is a power of two.
  const int shift = std::countr_zero(static_cast<unsigned>(level.step_px));
  const int first = begin >> shift;
  return {first, std::max(first, (end - 1 + level.step_px - level.side_px) >> shift)};
}

}  // namespace

DepthWindows::Level& begin_depth_windows(int width, int height, DepthWindows& windows) {
  if (windows.levels.empty()) windows.levels.emplace_back();
  DepthWindows::Level& image = windows.levels[0];
  image.side_px = image.step_px = 1;
  set_size(width, height, image);
  return image;
}

void build_depth_windows(DepthWindows& windows) {
  const int longest_px = std::max(windows.width(), windows.height());
  windows.level_count = 1;
  for (int side_px = 1; side_px < std::max(longest_px, DepthWindows::kMostPixels); side_px *= 2) {
    const int n = windows.level_count++;
    if (static_cast<int>(windows.levels.size()) == n) windows.levels.emplace_back();
    fill_level(windows.levels[n - 1], windows.row, windows.levels[n]);
  }
}

DepthUnits least_of(const DepthWindows& windows, const PixelRect& rect) {
  DepthUnits least = kEndlessUnits;
  const int longest_px = std::max(rect.u_end - rect.u_begin, rect.v_end - rect.v_begin);
  if (longest_px <= DepthWindows::kMostPixels) {
    for (int v = rect.v_begin; v < rect.v_end; ++v) {
      for (int u = rect.u_begin; u < rect.u_end; ++u) least = std::min(least, windows(u, v));
    }
    return least;
  }
  const DepthWindows::Level& level = windows.level_for(longest_px);
  for (const int row : windows_of(level, rect.v_begin, rect.v_end)) {
    for (const int column : windows_of(level, rect.u_begin, rect.u_end)) {
      least = std::min(least, level.row(row)[column]);
    }
  }
  return least;
}

}  // namespace berth
#endif  // HWY_ONCE
