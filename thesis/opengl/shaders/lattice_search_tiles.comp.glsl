// A finer lattice around the closest point, which stood for a tile of FORMER_PX: one point for each
// tile of TILE_PX in a window that holds this tile wherever the point lies in it, and half a tile
// more on each side of a point in its middle.
#ifndef TILE_PX
#define FORMER_PX 16
#define TILE_PX 8
#endif
#include "lattice_search.glsl"
#include "lattice_tile.glsl"

uniform sampler2D robot_depth_m;
uniform usampler2D link_id;

const int kWindowPx = 2 * FORMER_PX;
const int kTiles = (kWindowPx + TILE_PX - 1) / TILE_PX;
shared uint least_rank[kTiles * kTiles];

ivec2 place_of(uint number) { return ivec2(number % uint(kWindowPx), number / uint(kWindowPx)); }
ivec2 pixel_at(ivec2 place) { return unpack(former.robot) - FORMER_PX + place; }

bool is_of_link(ivec2 pixel, uint link) {
  bool is_inside = all(greaterThanEqual(pixel, ivec2(0))) &&
                   all(lessThan(pixel, textureSize(link_id, 0)));
  return is_inside && texelFetch(link_id, pixel, 0).x == link + 1u;
}

uint find_candidates(uint link) {
  if (!has_pair(former)) return 0u;
  for (uint i = gl_LocalInvocationIndex; i < uint(kTiles * kTiles); i += kThreads) {
    least_rank[i] = kNoPoint;
  }
  barrier();
  for (uint i = gl_LocalInvocationIndex; i < uint(kWindowPx * kWindowPx); i += kThreads) {
    ivec2 place = place_of(i);
    if (!is_of_link(pixel_at(place), link)) continue;
    ivec2 tile = place / TILE_PX;
    atomicMin(least_rank[tile.y * kTiles + tile.x], rank_in_tile(place % TILE_PX, TILE_PX, i));
  }
  barrier();
  return uint(kTiles * kTiles);
}

bool is_candidate(uint link, uint i, out ivec2 pixel, out float depth_m) {
  pixel = ivec2(0);
  depth_m = 0.0;
  if (least_rank[i] == kNoPoint) return false;
  pixel = pixel_at(place_of(number_of(least_rank[i])));
  depth_m = texelFetch(robot_depth_m, pixel, 0).x;
  return true;
}
