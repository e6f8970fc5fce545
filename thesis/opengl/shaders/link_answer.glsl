// What is read back of one link.
struct LinkAnswer {
  ClosestPair pair;
  uint robot_pixels;
  uint pairs_lo;  // of a 64-bit number
  uint pairs_hi;
  // The region of surveillance of the closest robot pixel: columns and rows, as PixelRect.
  int u_begin;
  int v_begin;
  int u_end;
  int v_end;
  float max_depth_m;  // its farthest depth
};
