// The closest pair of each robot tile, as far as it can be its link's: obstacle nodes and then their
// tiles are pruned by the lower bound, the pixels of the other tiles are all tried.
// One workgroup a robot tile, as long as there are more.
#include "metric.glsl"
#include "lower_bound.glsl"
#include "obstacle_tile.glsl"
#include "pixels.glsl"
#include "robot_tile.glsl"
#include "closest_pair.glsl"

layout(local_size_x = 256) in;

uniform ivec2 tiles;  // columns and rows of obstacle tiles
uniform sampler2D obstacle_depth_m;
uniform sampler2D robot_depth_m;
uniform usampler2D link_id;
layout(std430) readonly buffer ObstacleTiles { ObstacleTile obstacle_tiles[]; };
layout(std430) readonly buffer ObstacleNodes { ObstacleTile obstacle_nodes[]; };
layout(std430) readonly buffer RobotTiles { RobotTile robot_tiles[]; };
layout(std430) readonly buffer RobotTileCount { uint robot_tile_count; };
layout(std430) coherent buffer LinkBest { uint link_best[]; };
layout(std430) writeonly buffer TileBest { ClosestPair tile_best[]; };
layout(std430) writeonly buffer TilePairs { uint tile_pairs[]; };

// Bounds and distances round differently: what is this much above the best is still tried.
const float kRounding = 1e-5;
const int kTilePixels = kTilePx * kTilePx;
const int kThreads = 256;

shared int near_nodes[kThreads];
shared uint near_node_count;
shared ivec2 near_tiles[kThreads];
shared uint near_tile_count;
shared float robot_m[kTilePixels];
shared ivec2 robot_px[kTilePixels];
shared uint robot_pixels;
shared float limit_m2;
shared uint least;
shared uint pairs;

PixelBox box_of(RobotTile robot) {
  ivec2 u = unpack(robot.u_begin_end);
  ivec2 v = unpack(robot.v_begin_end);
  return PixelBox(vec2(u.x, v.x), vec2(u.y, v.y), robot.depth_lo_m, robot.depth_hi_m);
}

// Place i of a tile, row by row.
ivec2 offset_of(uint i) { return ivec2(i % uint(kTilePx), i / uint(kTilePx)); }

// `obstacle` is a square with this corner.
bool may_be_closer(PixelBox robot, ObstacleTile obstacle, ivec2 corner_px, int side_px) {
  if (obstacle.nearest == kNoPixel) return false;
  PixelBox box = PixelBox(vec2(corner_px), vec2(corner_px + side_px), obstacle.depth_lo_m,
                          obstacle.depth_hi_m);
  return lower_bound_m2(robot, box, sqrt(limit_m2)) * (1.0 - kRounding) <= limit_m2;
}

// The tile's pixels of this link, into shared memory.
void gather_robot_pixels(RobotTile robot) {
  if (gl_LocalInvocationIndex >= uint(kTilePixels)) return;
  ivec2 pixel = kTilePx * unpack(robot.place) + offset_of(gl_LocalInvocationIndex);
  bool is_inside = all(lessThan(pixel, textureSize(link_id, 0)));
  if (!is_inside || texelFetch(link_id, pixel, 0).x != robot.link + 1u) return;
  uint i = atomicAdd(robot_pixels, 1u);
  robot_m[i] = texelFetch(robot_depth_m, pixel, 0).x;
  robot_px[i] = pixel;
}

// One obstacle pixel against all robot pixels of the tile.
void try_pixel(ivec2 pixel, float depth_m, inout ClosestPair best) {
  for (uint i = 0u; i < robot_pixels; ++i) {
    float m2 = squared_distance_m2(robot_px[i], robot_m[i], pixel, depth_m);
    if (m2 > best.squared_m2) continue;
    ClosestPair pair = ClosestPair(m2, robot_m[i], depth_m, pack(robot_px[i]), pack(pixel));
    if (is_closer(pair, best)) best = pair;
  }
}

void try_near_tiles(inout ClosestPair best) {
  uint own_pairs = 0u;
  uint work = near_tile_count * uint(kTilePixels);
  for (uint i = gl_LocalInvocationIndex; i < work; i += uint(kThreads)) {
    ivec2 pixel = kTilePx * near_tiles[i / uint(kTilePixels)] + offset_of(i % uint(kTilePixels));
    if (any(greaterThanEqual(pixel, textureSize(obstacle_depth_m, 0)))) continue;
    float depth_m = texelFetch(obstacle_depth_m, pixel, 0).x;
    if (!(depth_m > 0.0)) continue;
    try_pixel(pixel, depth_m, best);
    own_pairs += robot_pixels;
  }
  atomicAdd(pairs, own_pairs);
}

// Of kThreads nodes from `base` on, those that may hold a closer pixel.
void find_near_nodes(PixelBox robot, int base, ivec2 nodes) {
  if (gl_LocalInvocationIndex == 0) near_node_count = 0u;
  barrier();
  int node = base + int(gl_LocalInvocationIndex);
  if (node < nodes.x * nodes.y) {
    ivec2 corner_px = kTilePx * tile_of_node(node, 0, nodes);
    if (may_be_closer(robot, obstacle_nodes[node], corner_px, kNodeSide * kTilePx)) {
      near_nodes[atomicAdd(near_node_count, 1u)] = node;
    }
  }
  barrier();
}

// Of kThreads tiles of the near nodes, those that may hold a closer pixel.
void find_near_tiles(PixelBox robot, uint base, ivec2 nodes) {
  if (gl_LocalInvocationIndex == 0) near_tile_count = 0u;
  barrier();
  uint child = base + gl_LocalInvocationIndex;
  if (child < near_node_count * uint(kNodeTiles)) {
    ivec2 tile = tile_of_node(near_nodes[child / uint(kNodeTiles)], int(child % uint(kNodeTiles)), nodes);
    if (all(lessThan(tile, tiles)) &&
        may_be_closer(robot, obstacle_tiles[tile.y * tiles.x + tile.x], kTilePx * tile, kTilePx)) {
      near_tiles[atomicAdd(near_tile_count, 1u)] = tile;
    }
  }
  barrier();
}

// What the workgroup found lowers the link's limit, and what others found lowers this one's.
void share_limit(uint link, float own_m2) {
  atomicMin(least, floatBitsToUint(own_m2));
  barrier();
  if (gl_LocalInvocationIndex == 0) {
    uint former = atomicMin(link_best[link], least);
    limit_m2 = uintBitsToFloat(min(former, least));
  }
  barrier();
}

void search(uint t) {
  RobotTile robot = robot_tiles[t];
  if (gl_LocalInvocationIndex == 0) {
    robot_pixels = 0u;
    pairs = 0u;
    least = floatBitsToUint(kFarthest_m2);
    limit_m2 = uintBitsToFloat(link_best[robot.link]);
  }
  barrier();
  gather_robot_pixels(robot);
  PixelBox robot_box = box_of(robot);
  ClosestPair best = no_pair();
  ivec2 nodes = nodes_of(tiles);
  for (int base = 0; base < nodes.x * nodes.y; base += kThreads) {
    find_near_nodes(robot_box, base, nodes);
    for (uint child = 0u; child < near_node_count * uint(kNodeTiles); child += uint(kThreads)) {
      find_near_tiles(robot_box, child, nodes);
      if (near_tile_count == 0u) continue;
      try_near_tiles(best);
      share_limit(robot.link, best.squared_m2);
    }
    barrier();
  }
  bool is_closest = is_closest_of_workgroup(best);
  if (gl_LocalInvocationIndex == 0) {
    tile_best[t] = no_pair();
    tile_pairs[t] = pairs;
  }
  barrier();
  if (is_closest) tile_best[t] = best;
}

void main() {
  for (uint t = gl_WorkGroupID.x; t < robot_tile_count; t += gl_NumWorkGroups.x) {
    search(t);
    barrier();
  }
}
