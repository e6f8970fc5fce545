// Pieces of pixels that are joined by depth, as trees of pixels: each pixel names one before it in
// its piece, the first pixel, its root, names itself. Obstacle pixels near the robot make pieces,
// and so do those that its growth dropped, apart from them.
const uint kNoPiece = 0xFFFFFFFFu;

struct Piece {
  uint parent;  // kNoPiece for all other pixels
  // Of a root: what its piece consists of.
  uint pixels;
  uint in_front;  // of the robot
  uint joined;    // to what: bits below
};
const uint kToFar = 1u;  // to an obstacle far from the robot
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
