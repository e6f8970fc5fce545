#pragma once

#include <vector>

#include "berth/types/image.hpp"

namespace berth {

/// Least and greatest value of an image in windows of 2 s x 2 s pixels in steps of s = 4, 8, 16,
/// ...: a rectangle of up to s + 1 pixels a side lies in the one that begins at its first pixel /
/// s.
struct DepthWindows {
  static constexpr int kFirstStepPx = 4;

  struct Level {
    int step_px = 0;
    int columns = 0;
    int rows = 0;
    /// Window (i, j) at [j * columns + i]; beyond the image's border it holds what lies inside.
    std::vector<float> least;
    std::vector<float> greatest;
  };

  /// The last of the first level_count has one window, which holds the image.
  std::vector<Level> levels;
  int level_count = 0;
  /// Scratch.
  std::vector<float> least_of_blocks;
  std::vector<float> greatest_of_blocks;
};

/// A NaN counts as +inf. The image is not empty; reuses the windows' memory.
void build_depth_windows(DepthView image, DepthWindows& windows);

}  // namespace berth
