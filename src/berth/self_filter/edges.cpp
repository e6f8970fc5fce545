#include "berth/self_filter/edges.hpp"

namespace berth {

void mark_mixed_pixels(DepthView sensor_depth_m, int v, float edge_jump_m, const FilterRow& row) {
  mark_mixed_row(row, 1, 2, sensor_depth_m.width - 2, edge_jump_m);
  if (v < 2 || v + 2 >= sensor_depth_m.height) return;
  mark_mixed_row(row, sensor_depth_m.stride, 0, sensor_depth_m.width, edge_jump_m);
}

}  // namespace berth
