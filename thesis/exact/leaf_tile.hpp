#pragma once

#include <cstdint>

#include "thesis/depth_tile.hpp"
#include "thesis/exact/lower_bound.hpp"

namespace berth {

/// What the search sees of 8 x 8 pixels: a tight box, the corner, the depths, and which pixels
/// count (bit 8 v + u; those without a depth never do).
struct LeafTile {
  PixelBox box;
  float u;
  float v;
  DepthSquare depths;
  std::uint64_t bits;
};

}  // namespace berth
