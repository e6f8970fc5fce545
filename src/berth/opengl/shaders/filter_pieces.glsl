// Pieces of pixels that are joined by depth, as trees of pixels: each pixel names one before it in
// its piece, the first pixel, its root, names itself.
const uint kNoPiece = 0xFFFFFFFFu;

struct Piece {
  uint parent;  // kNoPiece for pixels that are not near the robot
  // Of a root: what its piece consists of.
  uint pixels;
  uint in_front;  // of the robot
  uint leaves;    // not 0 where it is joined to an obstacle far from the robot
};
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
