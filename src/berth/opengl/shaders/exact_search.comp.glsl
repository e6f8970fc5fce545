// The closest pair of each robot tile, as far as it can be its link's: obstacle tiles are pruned by
// the lower bound of depth-space section 9, the pixels of the others are all tried.
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
layout(std430) readonly buffer RobotTiles { RobotTile robot_tiles[]; };
layout(std430) readonly buffer RobotTileCount { uint robot_tile_count; };
layout(std430) coherent buffer LinkBest { uint link_best[]; };
layout(std430) writeonly buffer TileBest { ClosestPair tile_best[]; };
layout(std430) writeonly buffer TilePairs { uint tile_pairs[]; };

// Bounds and distances round differently: what is this much above the best is still tried.
const float kRounding = 1e-5;
const int kTilePixels = kTilePx * kTilePx;
const int kThreads = 256;

shared uint near_tiles[kThreads];
shared uint near_count;
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

ivec2 corner_of(uint tile) { return kTilePx * ivec2(tile % uint(tiles.x), tile / uint(tiles.x)); }

// Place i of a tile, row by row.
ivec2 offset_of(uint i) { return ivec2(i % uint(kTilePx), i / uint(kTilePx)); }

bool may_be_closer(PixelBox robot, uint tile) {
  ObstacleTile obstacle = obstacle_tiles[tile];
  if (obstacle.nearest == kNoPixel) return false;
  vec2 corner = vec2(corner_of(tile));
  PixelBox box =
      PixelBox(corner, corner + float(kTilePx), obstacle.depth_lo_m, obstacle.depth_hi_m);
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
  uint work = near_count * uint(kTilePixels);
  for (uint i = gl_LocalInvocationIndex; i < work; i += uint(kThreads)) {
    ivec2 pixel = corner_of(near_tiles[i / uint(kTilePixels)]) + offset_of(i % uint(kTilePixels));
    if (any(greaterThanEqual(pixel, textureSize(obstacle_depth_m, 0)))) continue;
    float depth_m = texelFetch(obstacle_depth_m, pixel, 0).x;
    if (!(depth_m > 0.0)) continue;
    try_pixel(pixel, depth_m, best);
    own_pairs += robot_pixels;
  }
  atomicAdd(pairs, own_pairs);
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
  uint count = uint(tiles.x * tiles.y);
  for (uint base = 0u; base < count; base += uint(kThreads)) {
    if (gl_LocalInvocationIndex == 0) near_count = 0u;
    barrier();
    uint tile = base + gl_LocalInvocationIndex;
    if (tile < count && may_be_closer(robot_box, tile)) near_tiles[atomicAdd(near_count, 1u)] = tile;
    barrier();
    if (near_count == 0u) continue;
    try_near_tiles(best);
    share_limit(robot.link, best.squared_m2);
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
