// A tile of 8 x 8 pixels of the obstacle image, row by row of the image.
const int kTilePx = 8;
const uint kNoPixel = 0xFFFFFFFFu;
const uint kNoDepthBits = 0x7F7FFFFFu;  // the greatest float

struct ObstacleTile {
  float depth_lo_m;  // above depth_hi_m where the tile has no reading
  float depth_hi_m;  // 0 there
  uint nearest;      // number of the nearest pixel in the tile, row by row
  uint unused;
};
