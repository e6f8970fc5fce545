// Padding: obstacles that belong to a disc around an outline pixel.
#include "filter_fates.glsl"
#include "filter_tile.glsl"
#include "filter_disc.glsl"
#include "pixels.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D sensor_depth_m;
layout(r32ui) uniform uimage2D fate;
layout(std430) readonly buffer FilterTiles { FilterTile tiles[]; };
layout(std430) readonly buffer Discs { Disc discs[]; };
layout(std430) readonly buffer FilterFrame {
  uint reach_px;
};

shared uint open_pixels;
shared Disc near_discs[kTilePixels];

// As in self_filter/discs.hpp.
const int kLeastOnSurface = 5;
const float kSurfaceJump_m = 0.03;

bool is_on_surface(ivec2 pixel, float reading_m) {
  ivec2 size = textureSize(sensor_depth_m, 0);
  precise float jump_m = kSurfaceJump_m * max(1.0, reading_m * reading_m);
  int joined = 0;
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      ivec2 neighbour = pixel + ivec2(du, dv);
      if ((du == 0 && dv == 0) || any(lessThan(neighbour, ivec2(0))) ||
          any(greaterThanEqual(neighbour, size))) {
        continue;
      }
      float neighbour_m = texelFetch(sensor_depth_m, neighbour, 0).x;
      if (neighbour_m > 0.0 && abs(neighbour_m - reading_m) <= jump_m) ++joined;
    }
  }
  return joined >= kLeastOnSurface;
}

bool covers(Disc disc, ivec2 pixel, float reading_m, bool on_surface) {
  if (reading_m < disc.least_m || (on_surface && reading_m > disc.most_m)) return false;
  ivec2 offset = pixel - unpack(disc.place);
  double dv = double(offset.y);
  precise double width2_px2 = disc.radius2_px2 - disc.squash * dv * dv;
  return width2_px2 >= 0.0LF && double(offset.x * offset.x) <= width2_px2;
}

// Pixels from one tile to another along one axis.
int gap_px(int a, int b) { return max(0, (abs(a - b) - 1) * kTilePx + 1); }

bool may_reach(ivec2 other, FilterTile tile, float reach) {
  if (tile.discs == 0u) return false;
  vec2 gap = vec2(gap_px(other.x, int(gl_WorkGroupID.x)), gap_px(other.y, int(gl_WorkGroupID.y)));
  return dot(gap, gap) <= reach * reach;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = imageSize(fate);
  if (gl_LocalInvocationIndex == 0) open_pixels = 0u;
  barrier();
  bool is_open = false;
  if (all(lessThan(pixel, size))) {
    is_open = imageLoad(fate, pixel).x == kObstacle;
  }
  if (is_open) atomicAdd(open_pixels, 1u);
  barrier();
  if (open_pixels == 0u) return;

  float reading_m = is_open ? texelFetch(sensor_depth_m, pixel, 0).x : 0.0;
  bool on_surface = is_open && is_on_surface(pixel, reading_m);
  int near = (int(reach_px) + kTilePx - 1) / kTilePx;
  ivec2 last_tile = ivec2(tile_columns(size), tile_rows(size)) - 1;
  ivec2 first = clamp(ivec2(gl_WorkGroupID.xy) - near, ivec2(0), last_tile);
  ivec2 last = clamp(ivec2(gl_WorkGroupID.xy) + near, ivec2(0), last_tile);
  for (int row = first.y; row <= last.y; ++row) {
    for (int column = first.x; column <= last.x; ++column) {
      int number = row * (last_tile.x + 1) + column;
      FilterTile tile = tiles[number];
      if (!may_reach(ivec2(column, row), tile, tile.reach_px)) continue;
      if (gl_LocalInvocationIndex < tile.discs) {
        near_discs[gl_LocalInvocationIndex] =
            discs[uint(number) * kTilePixels + gl_LocalInvocationIndex];
      }
      barrier();
      for (uint i = 0u; is_open && i < tile.discs; ++i) {
        if (!covers(near_discs[i], pixel, reading_m, on_surface)) continue;
        is_open = false;
        imageStore(fate, pixel, uvec4(kPadding));
        atomicAdd(open_pixels, 0xFFFFFFFFu);
      }
      barrier();
      if (open_pixels == 0u) return;
    }
  }
}
