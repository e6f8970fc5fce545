// The lattice point of a tile of robot pixels: of each link the pixel nearest to the tile's centre
// (Manhattan distance, Hirt 3.1.3), of several the first in the order of the rows.

const uint kNoPoint = 0xFFFFFFFFu;

// Of the pixels of a tile the lattice point has the least. `place` is counted from the tile's corner,
// `number` below 65536 counts pixels row by row.
uint rank_in_tile(ivec2 place, int tile_px, uint number) {
  ivec2 twice = abs(2 * place + 1 - tile_px);
  return uint(twice.x + twice.y) << 16 | number;
}

uint number_of(uint rank) { return rank & 0xFFFFu; }
