// A tile of 16 x 16 pixels of the self filter; one workgroup a tile. Tiles are numbered row by row.
const int kTilePx = 16;
const uint kTilePixels = 256u;

struct FilterTile {
  uint discs;
  float reach_px;
};

// What an outline pixel's growth reaches, as in self_filter/discs.hpp.
struct Disc {
  double radius2_px2;  // negative where nothing
  double squash;
  float least_m;
  float most_m;
  uint place;  // packed pixel (pixels.glsl)
};

int tile_columns(ivec2 size) { return (size.x + kTilePx - 1) / kTilePx; }
int tile_rows(ivec2 size) { return (size.y + kTilePx - 1) / kTilePx; }
