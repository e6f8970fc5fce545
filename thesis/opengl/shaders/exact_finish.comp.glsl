// The closest pair of each link, of those of its tiles; one workgroup a link.
#include "pixels.glsl"
#include "closest_pair.glsl"
#include "robot_tile.glsl"
#include "link_answer.glsl"
#include "region_of_surveillance.glsl"

layout(local_size_x = 64) in;

uniform sampler2D robot_depth_m;
layout(std430) readonly buffer RobotTiles { RobotTile robot_tiles[]; };
layout(std430) readonly buffer RobotTileCount { uint robot_tile_count; };
layout(std430) readonly buffer LinkPixels { uint link_pixels[]; };
layout(std430) readonly buffer TileBest { ClosestPair tile_best[]; };
layout(std430) readonly buffer TilePairs { uint tile_pairs[]; };
layout(std430) writeonly buffer LinkAnswers { LinkAnswer answers[]; };

shared uint pairs_lo;
shared uint pairs_hi;

void main() {
  uint link = gl_WorkGroupID.x;
  if (gl_LocalInvocationIndex == 0) {
    pairs_lo = 0u;
    pairs_hi = 0u;
  }
  barrier();
  ClosestPair best = no_pair();
  for (uint t = gl_LocalInvocationIndex; t < robot_tile_count; t += gl_WorkGroupSize.x) {
    if (robot_tiles[t].link != link) continue;
    if (is_closer(tile_best[t], best)) best = tile_best[t];
    uint former = atomicAdd(pairs_lo, tile_pairs[t]);
    if (former + tile_pairs[t] < former) atomicAdd(pairs_hi, 1u);
  }
  bool is_closest = is_closest_of_workgroup(best);
  if (gl_LocalInvocationIndex == 0) {
    answers[link] = LinkAnswer(no_pair(), link_pixels[link], pairs_lo, pairs_hi, 0, 0, 0, 0, 0.0);
  }
  barrier();
  if (!is_closest) return;
  ivec4 region = region_of_surveillance(unpack(best.robot), best.robot_depth_m,
                                        textureSize(robot_depth_m, 0));
  answers[link] = LinkAnswer(best, link_pixels[link], pairs_lo, pairs_hi, region.x, region.y,
                             region.z, region.w, float(double(best.robot_depth_m) + range_m));
}
