// Pieces of pixels that are joined by depth, as trees of pixels: each pixel names one before it in
// its piece, the first pixel, its root, names itself. Obstacle pixels where flying patches may lie make
// pieces, and so do those that padding or dilation dropped, apart from them.
const uint kNoPiece = 0xFFFFFFFFu;

uniform float flying_patch_jump_m;

// As in self_filter/joined.hpp; both have a reading.
bool is_joined(float a_m, float b_m) {
  float z_m = min(a_m, b_m);
  precise float step_m = abs(a_m - b_m);
  precise float most_m = flying_patch_jump_m * max(1.0, z_m * z_m);
  return step_m <= most_m;
}

struct Piece {
  uint parent;  // kNoPiece for all other pixels
  uint joined;  // of a root: what its piece is joined to, bits below
};
const uint kToFar = 1u;  // to an obstacle elsewhere
const uint kToOwn = 2u;  // to the robot's own readings (self_filter/seam.hpp)

layout(std430) coherent buffer Pieces { Piece pieces[]; };

uint number_of_pixel(ivec2 pixel, ivec2 size) { return uint(pixel.y * size.x + pixel.x); }

uint root_of(uint number) {
  while (pieces[number].parent != number) number = pieces[number].parent;
  return number;
}

// The root is the piece's first pixel whatever the order of the invocations.
void unite(uint a, uint b) {
  for (;;) {
    a = root_of(a);
    b = root_of(b);
    if (a == b) return;
    uint later = max(a, b);
    uint earlier = min(a, b);
    uint former = atomicCompSwap(pieces[later].parent, later, earlier);
    if (former == later) return;
    a = former;
    b = earlier;
  }
}
