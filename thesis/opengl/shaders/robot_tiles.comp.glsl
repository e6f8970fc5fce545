// Lists the links of each tile of 8 x 8 robot pixels; one workgroup a tile.
#include "pixels.glsl"
#include "robot_tile.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D robot_depth_m;
uniform usampler2D link_id;
uniform int link_count;
layout(std430) writeonly buffer RobotTiles { RobotTile robot_tiles[]; };
layout(std430) buffer RobotTileCount { uint robot_tile_count; };
layout(std430) buffer LinkPixels { uint link_pixels[]; };

const uint kNone = 0xFFFFFFFFu;
shared uint next_link;
shared uint pixels;
shared uint depth_lo;
shared uint depth_hi;
shared uint representative;
shared int u_lo;
shared int v_lo;
shared int u_hi;
shared int v_hi;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  bool is_inside = all(lessThan(pixel, textureSize(link_id, 0)));
  uint id = is_inside ? texelFetch(link_id, pixel, 0).x : 0u;
  uint link = id >= 1u && id <= uint(link_count) ? id - 1u : kNone;
  float depth_m = link != kNone ? texelFetch(robot_depth_m, pixel, 0).x : 0.0;
  uint bits = floatBitsToUint(depth_m);

  // The links of the tile, one after another; kNone is the last.
  for (uint passed = 0u;;) {
    if (gl_LocalInvocationIndex == 0) {
      next_link = kNone;
      pixels = 0u;
      depth_lo = kNone;
      depth_hi = 0u;
      representative = kNone;
      u_lo = 0xFFFF;
      v_lo = 0xFFFF;
      u_hi = 0;
      v_hi = 0;
    }
    barrier();
    if (link != kNone && link >= passed) atomicMin(next_link, link);
    barrier();
    uint current = next_link;
    if (current == kNone) return;
    bool belongs = link == current;
    if (belongs) {
      atomicAdd(pixels, 1u);
      atomicMin(depth_lo, bits);
      atomicMax(depth_hi, bits);
      atomicMin(u_lo, pixel.x);
      atomicMin(v_lo, pixel.y);
      atomicMax(u_hi, pixel.x + 1);
      atomicMax(v_hi, pixel.y + 1);
    }
    barrier();
    // The nearest pixel to the camera stands for all of them in the first guess.
    if (belongs && bits == depth_lo) atomicMin(representative, gl_LocalInvocationIndex);
    barrier();
    if (belongs && representative == gl_LocalInvocationIndex) {
      atomicAdd(link_pixels[current], pixels);
      robot_tiles[atomicAdd(robot_tile_count, 1u)] = RobotTile(
          current, pack(ivec2(gl_WorkGroupID.xy)), pack(ivec2(u_lo, u_hi)), pack(ivec2(v_lo, v_hi)),
          uintBitsToFloat(depth_lo), uintBitsToFloat(depth_hi), pack(pixel), depth_m);
    }
    passed = current + 1u;
    barrier();
  }
}
