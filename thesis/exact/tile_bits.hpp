// Sets of pixels of an 8 x 8 tile: bit 8 v + u is the pixel (u, v) of the tile.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "thesis/exact/lower_bound.hpp"

namespace berth {

/// The four squares of 4 x 4 pixels.
inline constexpr std::uint64_t kQuarters[4] = {0x0F0F0F0F, 0xF0F0F0F0, 0x0F0F0F0F00000000,
                                               0xF0F0F0F000000000};

/// The lowest of at least one bit.
inline int lowest_bit(std::uint64_t bits) { return std::countr_zero(bits); }

/// The box of at least one pixel of the tile with the corner (u, v), with an empty depth range.
inline PixelBox box_of_bits(std::uint64_t bits, float u, float v) {
  std::uint64_t columns = bits | bits >> 32;
  columns |= columns >> 16;
  columns = (columns | columns >> 8) & 0xFF;
  return {u + static_cast<float>(std::countr_zero(columns)),
          u + static_cast<float>(std::bit_width(columns)),
          v + static_cast<float>(std::countr_zero(bits) / 8),
          v + static_cast<float>((std::bit_width(bits) + 7) / 8),
          HUGE_VALF,
          -HUGE_VALF};
}

}  // namespace berth
