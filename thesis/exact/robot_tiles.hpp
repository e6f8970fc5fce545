#pragma once

#include <cstdint>
#include <vector>

#include "berth/types/robot_image.hpp"
#include "thesis/depth_tile.hpp"
#include "thesis/exact/lower_bound.hpp"

namespace berth {

/// The robot image link by link: tiles of 8 x 8 pixels with the pixels of one link, and nodes that
/// group the up to 16 tiles of a link in a square of 32 x 32 pixels.
struct RobotTiles {
  static constexpr int kNodeTiles = 16;

  struct Node {
    /// Tight boxes of the first tile_count tiles; the rest holds empty boxes.
    alignas(64) float u_lo[kNodeTiles];
    float u_hi[kNodeTiles];
    float v_lo[kNodeTiles];
    float v_hi[kNodeTiles];
    float depth_lo_m[kNodeTiles];
    float depth_hi_m[kNodeTiles];
    int tile_count;
    /// Their indices.
    int tile[kNodeTiles];
    /// Around all tiles.
    PixelBox box;
    /// The link's node before this one; -1 for none.
    int next;
  };

  /// Corner (u, v) of a tile in the image, and the link's pixels in it: bit 8 v + u.
  struct Tile {
    std::uint64_t bits;
    int u;
    int v;
  };

  struct Link {
    int pixels = 0;
    int node_count = 0;
    int last_node = -1;
  };

  std::vector<Tile> tiles;
  std::vector<Node> nodes;
  /// links[i] has the id i + 1.
  std::vector<Link> links;
};

/// Sorts the robot image into tiles; reuses the memory of `out`. Pixels of kEnvironmentLink are
/// left out; any other id above link_count is a programming error. The depths stay in the image.
void build_robot_tiles(const RobotImage& robot, int link_count, RobotTiles& out);

}  // namespace berth
