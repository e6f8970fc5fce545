#pragma once

#include <vector>

#include "berth/types/camera.hpp"
#include "thesis/searchable_depth.hpp"

namespace berth {

/// The tiles of an obstacle tree by what is needed for one to stand for its pixels, where they are
/// far from a robot pixel.
struct TileMeans {
  static constexpr int kTiles = ObstacleTree::kChildren;

  /// The tiles of one node of the tree's lowest level. The numbers of one without a reading mean
  /// nothing.
  struct Node {
    alignas(64) float count[kTiles];
    /// The mean of the pixels' upper left corners in frame C, all at depth 1.
    alignas(64) float x[kTiles];
    alignas(64) float y[kTiles];
    /// The same at the pixels' own depths.
    alignas(64) float x_m[kTiles];
    alignas(64) float y_m[kTiles];
    alignas(64) float z_m[kTiles];
    /// Of a ball that holds all these points, whichever corner of its pixel each is.
    alignas(64) float radius_m[kTiles];
  };

  /// Those of ObstacleTree::levels[0].
  std::vector<Node> nodes;
  /// The same ball at depth 1.
  float radius = 0;
};

/// Fills the nodes that have a pixel in the rectangle and a reading no deeper than max_depth_m;
/// reuses the memory.
void build_tile_means(const Camera& camera, const SearchableDepth& obstacles, const PixelRect& rect,
                      float max_depth_m, TileMeans& out);

/// The nodes of the tree's lowest level that have a pixel in the rectangle, by columns and rows.
PixelRect nodes_within(const ObstacleTree& tree, const PixelRect& rect);

}  // namespace berth
