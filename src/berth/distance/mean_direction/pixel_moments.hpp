// Moments of the places of some pixels of an 8 x 8 tile.
#pragma once

#include <array>
#include <cstdint>

namespace berth {

/// Sums over pixels of 1, u, u^2, v, u v and v^2, from the tile's first pixel.
struct PixelSums {
  std::int32_t count;
  std::int32_t u;
  std::int32_t uu;
  std::int32_t v;
  std::int32_t uv;
  std::int32_t vv;
};

/// For each set of columns of one row the sums of 1, u and u^2, 20 bits each.
constexpr std::array<std::uint64_t, 256> make_row_sums() {
  std::array<std::uint64_t, 256> table{};
  for (std::uint64_t row = 0; row < 256; ++row) {
    for (std::uint64_t u = 0; u < 8; ++u) {
      if (row >> u & 1) table[row] += 1 | u << 20 | u * u << 40;
    }
  }
  return table;
}
inline constexpr std::array<std::uint64_t, 256> kRowSums = make_row_sums();

/// Bits as in tile_bits.hpp.
inline PixelSums pixel_sums(std::uint64_t bits) {
  if (bits == ~std::uint64_t{0}) return {64, 224, 1120, 224, 784, 1120};
  const auto row = [&](int v) { return kRowSums[bits >> 8 * v & 0xFF]; };
  // Row v goes v times into sum_v, and v (v + 1) / 2 times into sum_w.
  std::uint64_t sum = 0;
  std::uint64_t sum_v = 0;
  std::uint64_t sum_w = 0;
  for (int v = 7; v > 0; --v) {
    sum += row(v);
    sum_v += sum;
    sum_w += sum_v;
  }
  sum += row(0);
  const auto field = [](std::uint64_t sums, int shift) {
    return static_cast<std::int32_t>(sums >> shift & 0xFFFFF);
  };
  return {field(sum, 0),   field(sum, 20),   field(sum, 40),
          field(sum_v, 0), field(sum_v, 20), field(2 * sum_w - sum_v, 0)};
}

}  // namespace berth
