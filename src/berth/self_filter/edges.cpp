#include "berth/self_filter/edges.hpp"

#include "berth/self_filter/rows.hpp"

namespace berth {

void mark_mixed_pixels(DepthView sensor_depth_m, float edge_jump_m, Image<PixelFate>& fate) {
  const int width = sensor_depth_m.width;
  for (int v = 0; v < sensor_depth_m.height; ++v) {
    const float* row = sensor_depth_m.row(v);
    mark_mixed_row(row, 1, 2, width - 2, edge_jump_m, fate.row(v));
    if (v < 2 || v + 2 >= sensor_depth_m.height) continue;
    mark_mixed_row(row, sensor_depth_m.stride, 0, width, edge_jump_m, fate.row(v));
  }
}

}  // namespace berth
