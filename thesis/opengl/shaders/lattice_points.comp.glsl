// Lists the first lattice: of each tile of TILE_PX x TILE_PX robot pixels one point for each of its
// links; and counts the links' pixels. One workgroup a tile.
#ifndef TILE_PX
#define TILE_PX 16
#endif
#include "pixels.glsl"
#include "lattice_point.glsl"
#include "lattice_tile.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D robot_depth_m;
uniform usampler2D link_id;
uniform int link_count;
layout(std430) writeonly buffer LatticePoints { LatticePoint points[]; };
layout(std430) buffer LatticePointCount { uint point_count; };
layout(std430) buffer LinkPixels { uint link_pixels[]; };

const int kThreads = 256;
const int kTilePixels = TILE_PX * TILE_PX;
const int kOwnPixels = (kTilePixels + kThreads - 1) / kThreads;
const uint kNone = 0xFFFFFFFFu;

shared uint next_link;
shared uint least_rank;
shared uint pixels;

ivec2 corner() { return TILE_PX * ivec2(gl_WorkGroupID.xy); }
int own_number(int i) { return int(gl_LocalInvocationIndex) + i * kThreads; }
ivec2 place_of(int number) { return ivec2(number % TILE_PX, number / TILE_PX); }

uint link_of(int number) {
  ivec2 pixel = corner() + place_of(number);
  if (number >= kTilePixels || any(greaterThanEqual(pixel, textureSize(link_id, 0)))) return kNone;
  uint id = texelFetch(link_id, pixel, 0).x;
  return id >= 1u && id <= uint(link_count) ? id - 1u : kNone;
}

void main() {
  uint links[kOwnPixels];
  for (int i = 0; i < kOwnPixels; ++i) links[i] = link_of(own_number(i));

  // The links of the tile, one after another; kNone is the last.
  for (uint passed = 0u;;) {
    if (gl_LocalInvocationIndex == 0) {
      next_link = kNone;
      least_rank = kNoPoint;
      pixels = 0u;
    }
    barrier();
    for (int i = 0; i < kOwnPixels; ++i) {
      if (links[i] != kNone && links[i] >= passed) atomicMin(next_link, links[i]);
    }
    barrier();
    uint current = next_link;
    if (current == kNone) return;
    for (int i = 0; i < kOwnPixels; ++i) {
      if (links[i] != current) continue;
      uint number = uint(own_number(i));
      atomicMin(least_rank, rank_in_tile(place_of(int(number)), TILE_PX, number));
      atomicAdd(pixels, 1u);
    }
    barrier();
    if (gl_LocalInvocationIndex == 0) {
      ivec2 pixel = corner() + place_of(int(number_of(least_rank)));
      points[atomicAdd(point_count, 1u)] =
          LatticePoint(current, pack(pixel), texelFetch(robot_depth_m, pixel, 0).x, 0u);
      atomicAdd(link_pixels[current], pixels);
    }
    passed = current + 1u;
    barrier();
  }
}
