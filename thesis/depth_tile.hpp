// Squares of depths of an image, read where they lie.
#pragma once

#include <algorithm>
#include <cstddef>

#include "berth/types/image.hpp"

namespace berth {

inline constexpr int kTilePx = 8;
inline constexpr int kTilePixels = kTilePx * kTilePx;
/// A node of the lowest level of an obstacle tree holds 4 x 4 tiles.
inline constexpr int kNodePx = 4 * kTilePx;

/// Rows of depths, `stride` apart; all can be read.
struct DepthSquare {
  const float* depth_m;
  std::ptrdiff_t stride;
};

/// Room for a square that the image's border cuts.
template <int side_px>
struct DepthSquareCopy {
  alignas(64) float depth_m[side_px * side_px];
};

/// The square with the corner (u, v) in the image. Where the border cuts it: a copy, NaN beyond.
template <int side_px>
DepthSquare depth_square(const DepthView& image_m, int u, int v, DepthSquareCopy<side_px>& copy) {
  if (u + side_px <= image_m.width && v + side_px <= image_m.height) {
    return {image_m.row(v) + u, image_m.stride};
  }
  std::fill_n(copy.depth_m, side_px * side_px, kNoDepth);
  const int width = std::min(side_px, image_m.width - u);
  const int height = std::min(side_px, image_m.height - v);
  for (int row = 0; row < height; ++row) {
    std::copy_n(image_m.row(v + row) + u, width, copy.depth_m + row * side_px);
  }
  return {copy.depth_m, side_px};
}

}  // namespace berth
