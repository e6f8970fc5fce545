// Joins neighbouring pixels whose depths differ little to pieces: where flying patches may lie, and what
// padding or dilation dropped.
#include "filter_fates.glsl"
#include "filter_pieces.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D sensor_depth_m;
layout(r32ui) uniform readonly uimage2D fate;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = textureSize(sensor_depth_m, 0);
  if (any(greaterThanEqual(pixel, size))) return;
  uint number = number_of_pixel(pixel, size);
  if (pieces[number].parent == kNoPiece) return;
  bool is_flying_patch = imageLoad(fate, pixel).x == kFlyingPatch;
  float depth_m = texelFetch(sensor_depth_m, pixel, 0).x;
  // The other four neighbours look at this one.
  const ivec2 kNext[4] = ivec2[4](ivec2(1, 0), ivec2(-1, 1), ivec2(0, 1), ivec2(1, 1));
  for (int i = 0; i < 4; ++i) {
    ivec2 next = pixel + kNext[i];
    if (next.x < 0 || any(greaterThanEqual(next, size))) continue;
    uint next_number = number_of_pixel(next, size);
    if (pieces[next_number].parent == kNoPiece) continue;
    if ((imageLoad(fate, next).x == kFlyingPatch) != is_flying_patch) continue;
    if (is_joined(texelFetch(sensor_depth_m, next, 0).x, depth_m)) unite(number, next_number);
  }
}
