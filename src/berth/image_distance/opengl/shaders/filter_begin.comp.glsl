// Where flying patches may lie, and what padding or dilation dropped: each such pixel begins as a piece of its
// own.
#include "filter_fates.glsl"
#include "filter_pieces.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

layout(r32ui) uniform readonly uimage2D fate;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = imageSize(fate);
  if (any(greaterThanEqual(pixel, size))) return;
  uint own = imageLoad(fate, pixel).x;
  uint number = number_of_pixel(pixel, size);
  pieces[number] = Piece(own == kFlyingPatch || is_grown(own) ? number : kNoPiece, 0u);
}
