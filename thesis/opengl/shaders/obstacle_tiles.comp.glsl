// The depth range of each tile of 8 x 8 obstacle pixels, and its nearest pixel; one workgroup a tile.
#include "obstacle_tile.glsl"
#include "pixels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D obstacle_depth_m;
layout(std430) writeonly buffer ObstacleTiles { ObstacleTile obstacle_tiles[]; };

shared uint depth_lo;
shared uint depth_hi;
shared uint nearest;

void main() {
  if (gl_LocalInvocationIndex == 0) {
    depth_lo = kNoDepthBits;
    depth_hi = 0;
    nearest = kNoPixel;
  }
  barrier();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  bool is_inside = all(lessThan(pixel, textureSize(obstacle_depth_m, 0)));
  float depth_m = is_inside ? texelFetch(obstacle_depth_m, pixel, 0).x : 0.0;
  // Numbers above 0 have the order of their bits.
  uint bits = floatBitsToUint(depth_m);
  if (depth_m > 0.0) {
    atomicMin(depth_lo, bits);
    atomicMax(depth_hi, bits);
  }
  barrier();
  if (depth_m > 0.0 && bits == depth_lo) atomicMin(nearest, pack(pixel));
  barrier();
  if (gl_LocalInvocationIndex == 0) {
    uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    obstacle_tiles[tile] =
        ObstacleTile(uintBitsToFloat(depth_lo), uintBitsToFloat(depth_hi), nearest);
  }
}
