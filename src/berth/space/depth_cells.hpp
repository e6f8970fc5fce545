#pragma once

#include <vector>

#include "berth/types/image.hpp"

namespace berth {

/// The depth ranges of an obstacle image as a 16-ary tree: cells of 8 x 8 pixels, above them cells
/// of 32, 128, ... pixels, each with 4 x 4 children, up to one that covers the image. A cell on an
/// edge holds near and far and nothing between: it has two ranges, the readings of its nearer and
/// of its farther half.
struct DepthCells {
  static constexpr int kChildren = 16;
  static constexpr int kCellPx = 8;

  /// The ranges of a node's children, by rows; [+inf, -inf] for one that is empty.
  struct Node {
    alignas(64) float lo_m[2][kChildren];
    alignas(64) float hi_m[2][kChildren];
  };

  /// The cells of one size; 4 x 4 of them lie in a node, and the nodes by rows.
  struct Level {
    int cell_px = 0;
    int node_columns = 0;
    int node_rows = 0;
    std::vector<Node> nodes;
  };

  /// levels[0] has cells of 8 pixels; the last of the first level_count has one node.
  std::vector<Level> levels;
  int level_count = 0;
};

/// Builds the tree of an image (NaN = no reading) of any size; reuses the tree's memory.
void build_depth_cells(DepthView depth_m, DepthCells& cells);

}  // namespace berth
