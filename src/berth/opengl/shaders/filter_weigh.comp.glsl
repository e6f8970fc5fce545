// What each piece consists of, at its root.
#include "filter_fates.glsl"
#include "filter_pieces.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D sensor_depth_m;
uniform usampler2D link_id;
layout(r32ui) uniform readonly uimage2D fate;
uniform float island_jump_m;

// Whether a joined neighbour is an obstacle pixel that is not near the robot.
bool leaves(ivec2 pixel, ivec2 size) {
  float depth_m = texelFetch(sensor_depth_m, pixel, 0).x;
  ivec2 first = max(pixel - 1, ivec2(0));
  ivec2 last = min(pixel + 1, size - 1);
  for (int v = first.y; v <= last.y; ++v) {
    for (int u = first.x; u <= last.x; ++u) {
      ivec2 next = ivec2(u, v);
      if (imageLoad(fate, next).x != kObstacle) continue;
      if (pieces[number_of_pixel(next, size)].parent != kNoPiece) continue;
      precise float step_m = abs(texelFetch(sensor_depth_m, next, 0).x - depth_m);
      if (step_m <= island_jump_m) return true;
    }
  }
  return false;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = textureSize(sensor_depth_m, 0);
  if (any(greaterThanEqual(pixel, size))) return;
  uint number = number_of_pixel(pixel, size);
  if (pieces[number].parent == kNoPiece) return;
  uint root = root_of(number);
  atomicAdd(pieces[root].pixels, 1u);
  if (is_evaluated(texelFetch(link_id, pixel, 0).x)) atomicAdd(pieces[root].in_front, 1u);
  if (leaves(pixel, size)) atomicOr(pieces[root].leaves, 1u);
}
