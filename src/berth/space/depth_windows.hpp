#pragma once

#include <vector>

#include "berth/types/depth_units.hpp"

namespace berth {

/// A depth image, and the least of it in windows of s x s pixels, s = 1, 2, 4, ..., that begin at
/// each g-th pixel: four of them cover a rectangle and little else.
struct DepthWindows {
  struct Level {
    /// s and g.
    int side_px = 0;
    int step_px = 0;
    int columns = 0;
    int rows = 0;
    /// Window (i, j) begins at pixel (g i, g j) and stands at [j * columns + i]; beyond the image's
    /// border it holds what lies inside. One number more follows: two are read at once.
    std::vector<DepthUnits> least;

    DepthUnits* row(int j) { return least.data() + static_cast<std::ptrdiff_t>(columns) * j; }
    const DepthUnits* row(int j) const {
      return least.data() + static_cast<std::ptrdiff_t>(columns) * j;
    }
    /// The longest side of a rectangle that windows which begin at its first pixel or before, and
    /// end at its last one or behind, leave no gap in.
    int longest_px() const { return 2 * (side_px - step_px + 1); }
  };

  /// The side up to which rectangles are looked up pixel by pixel, others in four windows.
  static constexpr int kMostPixels = 4;

  /// The first level_count are in use. The first one is the image, the last one's windows hold it.
  std::vector<Level> levels;
  int level_count = 0;
  /// Scratch.
  std::vector<DepthUnits> row;

  int width() const { return levels.empty() ? 0 : levels[0].columns; }
  int height() const { return levels.empty() ? 0 : levels[0].rows; }
  DepthUnits operator()(int u, int v) const { return levels[0].row(v)[u]; }

  /// The windows of which four cover a rectangle with a side of this number of pixels, more than
  /// kMostPixels.
  const Level& level_for(int longest_px) const {
    int n = 2;
    while (n + 1 < level_count && levels[n].longest_px() < longest_px) ++n;
    return levels[n];
  }
};

/// The image, for somebody to write; keeps its memory.
DepthWindows::Level& begin_depth_windows(int width, int height, DepthWindows& windows);
/// The windows of the image, which is not empty; reuses their memory.
void build_depth_windows(DepthWindows& windows);

/// The least of a rectangle in the image, and of little else.
DepthUnits least_of(const DepthWindows& windows, const PixelRect& rect);
inline float least_of_m(const DepthWindows& windows, const PixelRect& rect) {
  return in_metres(least_of(windows, rect));
}

}  // namespace berth
