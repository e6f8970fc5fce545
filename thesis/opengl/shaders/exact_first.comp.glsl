// A first bound for each link: each robot tile's nearest pixel and the nearest pixel of the obstacle
// node that comes closest to it, then of that node's tiles.
// One workgroup a robot tile, as long as there are more.
#include "metric.glsl"
#include "obstacle_tile.glsl"
#include "pixels.glsl"
#include "robot_tile.glsl"
#include "closest_pair.glsl"

layout(local_size_x = 64) in;

uniform ivec2 tiles;  // columns and rows of obstacle tiles
layout(std430) readonly buffer ObstacleTiles { ObstacleTile obstacle_tiles[]; };
layout(std430) readonly buffer ObstacleNodes { ObstacleTile obstacle_nodes[]; };
layout(std430) readonly buffer RobotTiles { RobotTile robot_tiles[]; };
layout(std430) readonly buffer RobotTileCount { uint robot_tile_count; };
// Of each link, the bits of the least D^2 so far.
layout(std430) buffer LinkBest { uint link_best[]; };

shared int closest_node;

// `place` says which tile or node it is.
void try_nearest(RobotTile robot, ObstacleTile obstacle, int place, inout ClosestPair best) {
  if (obstacle.nearest == kNoPixel) return;
  float m2 = squared_distance_m2(unpack(robot.representative), robot.representative_depth_m,
                                 unpack(obstacle.nearest), obstacle.depth_lo_m);
  if (m2 < best.squared_m2) best = ClosestPair(m2, 0.0, 0.0, uint(place), 0u);
}

void bound(RobotTile robot) {
  ivec2 nodes = nodes_of(tiles);
  ClosestPair best = no_pair();
  for (int i = int(gl_LocalInvocationIndex); i < nodes.x * nodes.y; i += int(gl_WorkGroupSize.x)) {
    try_nearest(robot, obstacle_nodes[i], i, best);
  }
  if (gl_LocalInvocationIndex == 0) closest_node = -1;
  if (is_closest_of_workgroup(best)) closest_node = int(best.robot);
  barrier();
  if (closest_node >= 0 && gl_LocalInvocationIndex < uint(kNodeTiles)) {
    ivec2 place = tile_of_node(closest_node, int(gl_LocalInvocationIndex), nodes);
    if (all(lessThan(place, tiles))) {
      try_nearest(robot, obstacle_tiles[place.y * tiles.x + place.x], closest_node, best);
    }
  }
  if (is_closest_of_workgroup(best)) {
    atomicMin(link_best[robot.link], floatBitsToUint(best.squared_m2));
  }
}

void main() {
  for (uint t = gl_WorkGroupID.x; t < robot_tile_count; t += gl_NumWorkGroups.x) {
    bound(robot_tiles[t]);
    barrier();
  }
}
