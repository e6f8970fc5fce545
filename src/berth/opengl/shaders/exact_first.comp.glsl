// A first bound for each link: pairs of one pixel of each robot tile and one of each obstacle tile.
// One workgroup a robot tile, as long as there are more.
#include "metric.glsl"
#include "obstacle_tile.glsl"
#include "pixels.glsl"
#include "robot_tile.glsl"

layout(local_size_x = 256) in;

uniform ivec2 tiles;  // columns and rows of obstacle tiles
layout(std430) readonly buffer ObstacleTiles { ObstacleTile obstacle_tiles[]; };
layout(std430) readonly buffer RobotTiles { RobotTile robot_tiles[]; };
layout(std430) readonly buffer RobotTileCount { uint robot_tile_count; };
// Of each link, the bits of the least D^2 so far.
layout(std430) buffer LinkBest { uint link_best[]; };

shared uint least;

void main() {
  for (uint t = gl_WorkGroupID.x; t < robot_tile_count; t += gl_NumWorkGroups.x) {
    RobotTile robot = robot_tiles[t];
    ivec2 robot_pixel = unpack(robot.representative);
    if (gl_LocalInvocationIndex == 0) least = kNoDepthBits;
    barrier();
    float own_m2 = uintBitsToFloat(kNoDepthBits);
    for (int i = int(gl_LocalInvocationIndex); i < tiles.x * tiles.y; i += int(gl_WorkGroupSize.x)) {
      ObstacleTile tile = obstacle_tiles[i];
      if (tile.nearest == kNoPixel) continue;
      ivec2 pixel = kTilePx * ivec2(i % tiles.x, i / tiles.x) +
                    ivec2(tile.nearest % uint(kTilePx), tile.nearest / uint(kTilePx));
      own_m2 = min(own_m2, squared_distance_m2(robot_pixel, robot.representative_depth_m, pixel,
                                               tile.depth_lo_m));
    }
    atomicMin(least, floatBitsToUint(own_m2));
    barrier();
    if (gl_LocalInvocationIndex == 0) atomicMin(link_best[robot.link], least);
    barrier();
  }
}
