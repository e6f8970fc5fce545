#pragma once

#include <cstddef>
#include <vector>

#include "berth/types/image.hpp"

namespace berth {

/// The depth ranges of an obstacle image as a 16-ary tree of squares: tiles of 8 x 8 pixels, above
/// them nodes of 32, 128, 512 ... pixels, each with 4 x 4 children, up to one root that covers the
/// image. The pixels themselves stay in the image.
struct ObstacleTree {
  static constexpr int kChildren = 16;

  /// The depth ranges of a node's children, which lie by rows; [+inf, -inf] for one without a
  /// reading.
  struct Node {
    alignas(64) float depth_lo_m[kChildren];
    alignas(64) float depth_hi_m[kChildren];
  };

  /// The nodes of one size, by rows.
  struct Level {
    int child_px = 0;
    int columns = 0;
    int rows = 0;
    std::vector<Node> nodes;
  };

  int width = 0;
  int height = 0;
  /// levels[0] has tiles for children; levels[level_count - 1] is the root alone. The rest is
  /// spare.
  std::vector<Level> levels;
  int level_count = 0;
};

/// Builds the tree of an image (NaN = no reading) of any size, 0 x 0 included; reuses the tree's
/// memory.
void build_obstacle_tree(DepthView depth_m, ObstacleTree& tree);

}  // namespace berth
