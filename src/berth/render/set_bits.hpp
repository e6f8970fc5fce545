// Inside render/ only.
#pragma once

#include <cstdint>

namespace berth {

/// The places of the bits that are set in each byte, the lowest first; zeros after them.
struct SetBits {
  std::uint8_t places[256][8] = {};

  constexpr SetBits() {
    for (int byte = 0; byte < 256; ++byte) {
      int count = 0;
      for (std::uint8_t bit = 0; bit < 8; ++bit) {
        if ((byte >> bit & 1) != 0) places[byte][count++] = bit;
      }
    }
  }
};

inline constexpr SetBits kSetBits;

}  // namespace berth
