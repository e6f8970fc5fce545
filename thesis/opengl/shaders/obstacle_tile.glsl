// Tiles of 8 x 8 pixels of the obstacle image, row by row of the image, and nodes of 4 x 4 tiles.
const int kTilePx = 8;
const int kNodeSide = 4;
const int kNodeTiles = kNodeSide * kNodeSide;
const uint kNoPixel = 0xFFFFFFFFu;
const uint kNoDepthBits = 0x7F7FFFFFu;  // the greatest float

struct ObstacleTile {
  float depth_lo_m;  // above depth_hi_m where there is no reading
  float depth_hi_m;  // 0 there
  uint nearest;      // the nearest pixel, packed (pixels.glsl); kNoPixel there
};

// Columns and rows of nodes.
ivec2 nodes_of(ivec2 tiles) { return (tiles + kNodeSide - 1) / kNodeSide; }

// Column and row of a node's tile; may lie outside of the image.
ivec2 tile_of_node(int node, int child, ivec2 nodes) {
  return kNodeSide * ivec2(node % nodes.x, node / nodes.x) +
         ivec2(child % kNodeSide, child / kNodeSide);
}
