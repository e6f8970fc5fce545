// Sets of pixels of an 8 x 8 tile: bit 8 v + u is the pixel (u, v) of the tile.
#pragma once

#include <algorithm>
#include <cstdint>

namespace berth {

/// The pixels of a tile in the columns before `column`, which is 0 to 8.
inline std::uint64_t columns_before(int column) {
  return ((std::uint64_t{1} << column) - 1) * 0x0101010101010101;
}

/// The pixels of a tile in the rows before `row`, which is 0 to 8.
inline std::uint64_t rows_before(int row) {
  return row < 8 ? (std::uint64_t{1} << 8 * row) - 1 : ~std::uint64_t{0};
}

/// The pixels of a tile in the columns from u_begin up to u_end and the rows from v_begin up to
/// v_end, of any size, from the tile's first pixel.
inline std::uint64_t pixels_within(int u_begin, int v_begin, int u_end, int v_end) {
  const auto in_tile = [](int x) { return std::clamp(x, 0, 8); };
  return columns_before(in_tile(u_end)) & ~columns_before(in_tile(u_begin)) &
         rows_before(in_tile(v_end)) & ~rows_before(in_tile(v_begin));
}

}  // namespace berth
