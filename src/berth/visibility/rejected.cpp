#include "berth/visibility/rejected.hpp"

#include <algorithm>
#include <cassert>

namespace berth {
namespace {

bool is_rejected(PixelFate fate) {
  return fate == PixelFate::flying_patch || fate == PixelFate::soft || fate == PixelFate::speckle;
}

}  // namespace

void clear_rejected(int width, int height, RejectedImage& out) {
  if (out.depth_m.width() != width || out.depth_m.height() != height) {
    out.depth_m.resize(width, height, kNoDepth);
  } else {
    for (const Pixel p : out.pixels) out.depth_m(p.u, p.v) = kNoDepth;
  }
  out.pixels.clear();
}

void find_rejected(DepthView sensor_depth_m, const ObstacleImage& obstacles, RejectedImage& out) {
  const int width = sensor_depth_m.width, height = sensor_depth_m.height;
  assert(obstacles.fate.width() == width && obstacles.fate.height() == height);
  clear_rejected(width, height, out);
  if (obstacles.count_of(PixelFate::flying_patch) + obstacles.count_of(PixelFate::soft) +
          obstacles.count_of(PixelFate::speckle) ==
      0) {
    return;
  }
  for (int v = 0; v < height; ++v) {
    const PixelFate* fate = obstacles.fate.row(v);
    // Most rows have none, and counting goes in vectors.
    if (std::count_if(fate, fate + width, is_rejected) == 0) continue;
    for (int u = 0; u < width; ++u) {
      if (!is_rejected(fate[u])) continue;
      out.depth_m(u, v) = sensor_depth_m(u, v);
      out.pixels.push_back({u, v});
    }
  }
}

}  // namespace berth
