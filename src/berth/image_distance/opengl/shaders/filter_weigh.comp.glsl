// What each piece is joined to, at its root.
#include "filter_fates.glsl"
#include "filter_pieces.glsl"
#include "tolerance.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D sensor_depth_m;
uniform sampler2D robot_depth_m;
layout(r32ui) uniform readonly uimage2D fate;

// What a neighbour means to the piece that is joined to it.
uint meaning(ivec2 pixel, float reading_m) {
  uint own = imageLoad(fate, pixel).x;
  if (own == kRobot) {
    return reading_m <= greatest_reading_m(texelFetch(robot_depth_m, pixel, 0).x) ? kToOwn : 0u;
  }
  return own == kObstacle ? kToFar : 0u;
}

uint joined_to(ivec2 pixel, ivec2 size) {
  float depth_m = texelFetch(sensor_depth_m, pixel, 0).x;
  ivec2 first = max(pixel - 1, ivec2(0));
  ivec2 last = min(pixel + 1, size - 1);
  uint joined = 0u;
  for (int v = first.y; v <= last.y; ++v) {
    for (int u = first.x; u <= last.x; ++u) {
      float reading_m = texelFetch(sensor_depth_m, ivec2(u, v), 0).x;
      if (is_joined(reading_m, depth_m)) joined |= meaning(ivec2(u, v), reading_m);
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
  uint joined = joined_to(pixel, size);
  if (joined != 0u) atomicOr(pieces[root_of(number)].joined, joined);
}
