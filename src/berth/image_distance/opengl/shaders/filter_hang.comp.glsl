// A piece hangs on the robot's own readings also by way of what the robot's growth
// dropped.
#include "filter_fates.glsl"
#include "filter_pieces.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D sensor_depth_m;
layout(r32ui) uniform readonly uimage2D fate;

bool hangs(ivec2 pixel, ivec2 size) {
  float depth_m = texelFetch(sensor_depth_m, pixel, 0).x;
  ivec2 first = max(pixel - 1, ivec2(0));
  ivec2 last = min(pixel + 1, size - 1);
  for (int v = first.y; v <= last.y; ++v) {
    for (int u = first.x; u <= last.x; ++u) {
      ivec2 next = ivec2(u, v);
      if (!is_grown(imageLoad(fate, next).x)) continue;
      if (!is_joined(texelFetch(sensor_depth_m, next, 0).x, depth_m)) continue;
      if ((pieces[root_of(number_of_pixel(next, size))].joined & kToOwn) != 0u) return true;
    }
  }
  return false;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = textureSize(sensor_depth_m, 0);
  if (any(greaterThanEqual(pixel, size))) return;
  uint number = number_of_pixel(pixel, size);
  if (pieces[number].parent == kNoPiece || imageLoad(fate, pixel).x != kFlyingPatch) return;
  if (hangs(pixel, size)) atomicOr(pieces[root_of(number)].joined, kToOwn);
}
