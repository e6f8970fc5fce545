// The depth range of each node of 4 x 4 obstacle tiles, and its nearest pixel; one invocation a node.
#include "obstacle_tile.glsl"

layout(local_size_x = 64) in;

uniform ivec2 tiles;  // columns and rows of obstacle tiles
layout(std430) readonly buffer ObstacleTiles { ObstacleTile obstacle_tiles[]; };
layout(std430) writeonly buffer ObstacleNodes { ObstacleTile obstacle_nodes[]; };

void main() {
  ivec2 nodes = nodes_of(tiles);
  int node = int(gl_GlobalInvocationID.x);
  if (node >= nodes.x * nodes.y) return;
  ObstacleTile whole = ObstacleTile(uintBitsToFloat(kNoDepthBits), 0.0, kNoPixel);
  for (int child = 0; child < kNodeTiles; ++child) {
    ivec2 place = tile_of_node(node, child, nodes);
    if (any(greaterThanEqual(place, tiles))) continue;
    ObstacleTile tile = obstacle_tiles[place.y * tiles.x + place.x];
    whole.depth_hi_m = max(whole.depth_hi_m, tile.depth_hi_m);
    if (tile.depth_lo_m >= whole.depth_lo_m) continue;
    whole.depth_lo_m = tile.depth_lo_m;
    whole.nearest = tile.nearest;
  }
  obstacle_nodes[node] = whole;
}
