#include "berth/self_filter/region.hpp"

#include <cassert>

namespace berth {

void ignore_outside(const RobotImage& region, ObstacleImage& out) {
  assert(region.link_id.width() == out.fate.width() &&
         region.link_id.height() == out.fate.height());
  std::int64_t ignored = 0;
  for (int v = 0; v < out.fate.height(); ++v) {
    const LinkId* const id = region.link_id.row(v);
    PixelFate* const fate = out.fate.row(v);
    float* const depth_m = out.depth_m.row(v);
    for (int u = 0; u < out.fate.width(); ++u) {
      const bool is_ignored = fate[u] == PixelFate::obstacle && id[u] == kNoLink;
      fate[u] = is_ignored ? PixelFate::outside_region : fate[u];
      depth_m[u] = is_ignored ? kNoDepth : depth_m[u];
      ignored += is_ignored;
    }
  }
  out.count[static_cast<std::size_t>(PixelFate::obstacle)] -= ignored;
  out.count[static_cast<std::size_t>(PixelFate::outside_region)] += ignored;
}

}  // namespace berth
