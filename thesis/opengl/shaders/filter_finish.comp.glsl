// The robot-shaped region, then F and the count of each fate.
#include "filter_fates.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D sensor_depth_m;
uniform usampler2D region_id;
uniform int has_region;
layout(r32ui) uniform uimage2D fate;
layout(r32f) uniform writeonly image2D obstacle_depth_m;
layout(std430) buffer FateCounts { uint fate_count[]; };

shared uint tile_count[kFates];

uint last_fate(ivec2 pixel) {
  uint own = imageLoad(fate, pixel).x;
  if (own != kObstacle) return own;
  if (has_region != 0 && texelFetch(region_id, pixel, 0).x == kNoLink) return kOutsideRegion;
  return kObstacle;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = imageSize(fate);
  if (gl_LocalInvocationIndex < kFates) tile_count[gl_LocalInvocationIndex] = 0u;
  barrier();
  if (all(lessThan(pixel, size))) {
    uint own = last_fate(pixel);
    float reading_m = texelFetch(sensor_depth_m, pixel, 0).x;
    imageStore(fate, pixel, uvec4(own));
    imageStore(obstacle_depth_m, pixel, vec4(own == kObstacle ? reading_m : 0.0));
    atomicAdd(tile_count[own], 1u);
  }
  barrier();
  if (gl_LocalInvocationIndex < kFates && tile_count[gl_LocalInvocationIndex] > 0u) {
    atomicAdd(fate_count[gl_LocalInvocationIndex], tile_count[gl_LocalInvocationIndex]);
  }
}
