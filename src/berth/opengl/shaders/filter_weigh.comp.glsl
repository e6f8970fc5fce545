// What each piece consists of and is joined to, at its root.
#include "filter_fates.glsl"
#include "filter_pieces.glsl"
#include "tolerance.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D sensor_depth_m;
uniform sampler2D robot_depth_m;
uniform usampler2D link_id;
layout(r32ui) uniform readonly uimage2D fate;
uniform float island_jump_m;

// What a neighbour means to the piece that is joined to it.
uint meaning(ivec2 pixel, ivec2 size, float reading_m) {
  uint own = imageLoad(fate, pixel).x;
  if (own == kRobot) {
    return reading_m <= greatest_reading_m(texelFetch(robot_depth_m, pixel, 0).x) ? kToOwn : 0u;
  }
  if (own != kObstacle) return 0u;
  return pieces[number_of_pixel(pixel, size)].parent == kNoPiece ? kToFar : 0u;
}

uint joined_to(ivec2 pixel, ivec2 size) {
  float depth_m = texelFetch(sensor_depth_m, pixel, 0).x;
  ivec2 first = max(pixel - 1, ivec2(0));
  ivec2 last = min(pixel + 1, size - 1);
  uint joined = 0u;
  for (int v = first.y; v <= last.y; ++v) {
    for (int u = first.x; u <= last.x; ++u) {
      float reading_m = texelFetch(sensor_depth_m, ivec2(u, v), 0).x;
      precise float step_m = abs(reading_m - depth_m);
      if (step_m <= island_jump_m) joined |= meaning(ivec2(u, v), size, reading_m);
    }
  }
  return joined;
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
  uint joined = joined_to(pixel, size);
  if (joined != 0u) atomicOr(pieces[root].joined, joined);
}
