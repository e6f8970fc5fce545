#pragma once

#include <vector>

#include "berth/types/image.hpp"

namespace berth {

/// The least value of an image in windows of s x s pixels, s = 4, 8, 16, ..., that begin at each
/// g-th pixel: four of them cover a rectangle and little else.
struct DepthWindows {
  static constexpr int kFirstSidePx = 4;
  static constexpr int kFirstStepPx = 2;

  struct Level {
    /// s and g.
    int side_px = 0;
    int step_px = 0;
    int columns = 0;
    int rows = 0;
    /// Window (i, j) begins at pixel (g i, g j) and stands at [j * columns + i]; beyond the image's
    /// border it holds what lies inside.
    std::vector<float> least;

    /// The longest side of a rectangle that windows which begin at its first pixel or before, and
    /// end at its last one or behind, leave no gap in.
    int longest_px() const { return 2 * (side_px - step_px + 1); }
  };

  /// The first level_count are in use. The last one's windows hold the image.
  std::vector<Level> levels;
  int level_count = 0;
  /// Scratch.
  std::vector<float> pairs;
  std::vector<float> row;
};

/// A NaN counts as +inf. The image is not empty; reuses the windows' memory.
void build_depth_windows(DepthView image, DepthWindows& windows);

}  // namespace berth
