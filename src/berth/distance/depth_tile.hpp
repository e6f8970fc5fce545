// Eight by eight depths of an image, read where they lie.
#pragma once

#include <algorithm>
#include <cstddef>

#include "berth/types/image.hpp"

namespace berth {

inline constexpr int kTilePx = 8;
inline constexpr int kTilePixels = kTilePx * kTilePx;

/// Rows of 8 depths, `stride` apart; all can be read.
struct TileDepths {
  const float* depth_m;
  std::ptrdiff_t stride;
};

/// Room for a tile that the image's border cuts.
struct TileCopy {
  alignas(64) float depth_m[kTilePixels];
};

/// The tile with the corner (u, v) in the image. Where the border cuts it: a copy, NaN beyond.
inline TileDepths tile_depths(const DepthView& image_m, int u, int v, TileCopy& copy) {
  if (u + kTilePx <= image_m.width && v + kTilePx <= image_m.height) {
    return {image_m.row(v) + u, image_m.stride};
  }
  std::fill_n(copy.depth_m, kTilePixels, kNoDepth);
  const int width = std::min(kTilePx, image_m.width - u);
  const int height = std::min(kTilePx, image_m.height - v);
  for (int row = 0; row < height; ++row) {
    std::copy_n(image_m.row(v + row) + u, width, copy.depth_m + row * kTilePx);
  }
  return {copy.depth_m, kTilePx};
}

}  // namespace berth
