// Which part of some pixels of an 8 x 8 tile lies at which side of a robot pixel.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace berth {

/// The part of the pixels with a lower coordinate than the robot pixel along one axis, and the part
/// with a higher one; the rest shares its column or row.
struct FacingFractions {
  float below;
  float above;
};

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

/// At least one pixel and the robot's column, from the tile's first pixel.
inline FacingFractions fractions_of_columns(std::uint64_t pixels, int robot_column) {
  const int column = std::clamp(robot_column, -1, 8);
  const auto count = static_cast<float>(std::popcount(pixels));
  const std::uint64_t below = pixels & columns_before(std::max(column, 0));
  const std::uint64_t above = pixels & ~columns_before(std::min(column + 1, 8));
  return {static_cast<float>(std::popcount(below)) / count,
          static_cast<float>(std::popcount(above)) / count};
}

/// At least one pixel and the robot's row, from the tile's first pixel.
inline FacingFractions fractions_of_rows(std::uint64_t pixels, int robot_row) {
  const int row = std::clamp(robot_row, -1, 8);
  const auto count = static_cast<float>(std::popcount(pixels));
  const std::uint64_t below = pixels & rows_before(std::max(row, 0));
  const std::uint64_t above = pixels & ~rows_before(std::min(row + 1, 8));
  return {static_cast<float>(std::popcount(below)) / count,
          static_cast<float>(std::popcount(above)) / count};
}

}  // namespace berth
