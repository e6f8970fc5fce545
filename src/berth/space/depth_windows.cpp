#include "berth/space/depth_windows.hpp"

#include <algorithm>
#include <limits>

#include "berth/vector/divide_up.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/space/depth_windows.cpp"
#include "hwy/foreach_target.h"

#include "berth/space/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// The least of each 2 x 2 pixels of two rows.
void fill_row_of_pairs(const float* above, const float* below, int width, float* out) {
  constexpr int kStrip = 2 * kLanes;
  alignas(64) float padded[2][kStrip];
  alignas(64) float strip[kStrip];
  for (int u = 0; u < width; u += kStrip) {
    const float* a = padded_row(above + u, width - u, kStrip, padded[0]);
    const float* b = padded_row(below + u, width - u, kStrip, padded[1]);
    for (int i = 0; i < kStrip; i += kLanes) {
      store(least(nan_to_infinity(load(a + i)), nan_to_infinity(load(b + i))), strip + i);
    }
    halve_to_least(strip, kStrip);
    std::copy_n(strip, std::min(kLanes, (width - u + 1) / 2), out + u / 2);
  }
}

/// Of each number and the one `ahead` of it, of both rows; the last one stands for those beyond.
void fill_row_of_least(const float* above, const float* below, int columns, int ahead, float* out) {
  const int whole = std::max(0, columns - ahead);
  for_row(
      0, whole,
      [&](int i) {
        store(least(least(load(above + i), load(above + i + ahead)),
                    least(load(below + i), load(below + i + ahead))),
              out + i);
      },
      [&](int i) {
        out[i] = std::min({above[i], above[i + ahead], below[i], below[i + ahead]});
      });
  float least_above = std::numeric_limits<float>::infinity();
  for (int i = columns - 1; i >= whole; --i) {
    least_above = std::min({least_above, above[i], below[i]});
    out[i] = least_above;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(fill_row_of_pairs);
HWY_EXPORT(fill_row_of_least);

namespace {

/// Windows that begin at each `every`-th one of `from`, of which there are `columns` x `rows`, and
/// hold it and those `ahead` of it.
void fill_level(const std::vector<float>& from, int columns, int rows, int ahead, int every,
                std::vector<float>& row, DepthWindows::Level& level) {
  level.columns = divide_up(columns, every);
  level.rows = divide_up(rows, every);
  level.least.resize(static_cast<std::size_t>(level.columns) * level.rows);
  row.resize(columns);
  for (int j = 0; j < level.rows; ++j) {
    const float* above = from.data() + static_cast<std::size_t>(every) * j * columns;
    const float* below =
        from.data() + static_cast<std::size_t>(std::min(every * j + ahead, rows - 1)) * columns;
    float* out = level.least.data() + static_cast<std::size_t>(j) * level.columns;
    HWY_DYNAMIC_DISPATCH(fill_row_of_least)
    (above, below, columns, ahead, every == 1 ? out : row.data());
    if (every == 1) continue;
    for (int i = 0; i < level.columns; ++i) out[i] = row[every * i];
  }
}

}  // namespace

void build_depth_windows(DepthView image, DepthWindows& windows) {
  constexpr int kPair = DepthWindows::kFirstStepPx;
  const int columns = divide_up(image.width, kPair);
  const int rows = divide_up(image.height, kPair);
  windows.pairs.resize(static_cast<std::size_t>(columns) * rows);
  for (int j = 0; j < rows; ++j) {
    HWY_DYNAMIC_DISPATCH(fill_row_of_pairs)
    (image.row(kPair * j), image.row(std::min(kPair * j + 1, image.height - 1)), image.width,
     windows.pairs.data() + static_cast<std::size_t>(j) * columns);
  }
  windows.level_count = 0;
  int side_px = DepthWindows::kFirstSidePx;
  for (bool is_last = false; !is_last; side_px *= 2) {
    const int n = windows.level_count++;
    if (static_cast<int>(windows.levels.size()) == n) windows.levels.emplace_back();
    DepthWindows::Level& level = windows.levels[n];
    level.side_px = side_px;
    level.step_px = std::max(kPair, side_px / 4);
    if (n == 0) {
      fill_level(windows.pairs, columns, rows, 1, 1, windows.row, level);
    } else {
      const DepthWindows::Level& below = windows.levels[n - 1];
      fill_level(below.least, below.columns, below.rows, below.side_px / below.step_px,
                 level.step_px / below.step_px, windows.row, level);
    }
    is_last = side_px >= std::max(image.width, image.height);
  }
}

}  // namespace berth
#endif  // HWY_ONCE
