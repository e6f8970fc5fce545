// The pixels of one link in a tile of 8 x 8 robot pixels. Pixels are packed (pixels.glsl).
struct RobotTile {
  uint link;         // id - 1
  uint place;        // the tile's column, and its row << 16
  uint u_begin_end;  // the columns of its pixels: first, and one after the last << 16
  uint v_begin_end;  // their rows
  float depth_lo_m;
  float depth_hi_m;
  uint representative;  // one of its pixels: column, and row << 16
  float representative_depth_m;
};
