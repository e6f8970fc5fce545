#include "berth/self_filter/edges.hpp"

#include <algorithm>
#include <cmath>

namespace berth {
namespace {

/// The reading s and its two neighbours on both sides, along a row or a column. NaN compares false.
bool is_mixed(const float* s, std::ptrdiff_t step, float jump_at_1m_m) {
  const float jump_m = jump_at_1m_m * std::max(1.0F, *s * *s);
  const float before = s[-step];
  const float after = s[step];
  const bool flat =
      std::abs(before - s[-2 * step]) <= jump_m && std::abs(after - s[2 * step]) <= jump_m;
  return flat && *s - std::min(before, after) > jump_m && std::max(before, after) - *s > jump_m;
}

}  // namespace

void mark_mixed_pixels(DepthView sensor_depth_m, float edge_jump_m, Image<PixelFate>& fate) {
  const int width = sensor_depth_m.width;
  const int height = sensor_depth_m.height;
  for (int v = 0; v < height; ++v) {
    const float* row = sensor_depth_m.row(v);
    for (int u = 0; u < width; ++u) {
      if (fate(u, v) != PixelFate::obstacle) continue;
      const bool across = u >= 2 && u + 2 < width && is_mixed(row + u, 1, edge_jump_m);
      const bool along =
          v >= 2 && v + 2 < height && is_mixed(row + u, sensor_depth_m.stride, edge_jump_m);
      if (across || along) fate(u, v) = PixelFate::edge;
    }
  }
}

}  // namespace berth
