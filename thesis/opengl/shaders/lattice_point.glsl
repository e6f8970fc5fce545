// A robot pixel that is tried for its link.
struct LatticePoint {
  uint link;   // id - 1
  uint pixel;  // column, and row << 16
  float depth_m;
  uint unused;
};
