// Inside self_filter/ only: the image cut into tiles, the unit of its work on several threads.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"

namespace berth {

inline constexpr int kTileWidth_px = 16;
inline constexpr int kTileHeight_px = 8;

/// Some of a tile's pixels: of each of its rows, bit i is its column i.
using TileBits = std::array<std::uint16_t, kTileHeight_px>;

/// Column and row count tiles from the top left; those at the right and lower border may be cut.
struct TileGrid {
  int width_px = 0;
  int height_px = 0;

  bool operator==(const TileGrid&) const = default;
  int columns() const { return (width_px + kTileWidth_px - 1) / kTileWidth_px; }
  int rows() const { return (height_px + kTileHeight_px - 1) / kTileHeight_px; }
  std::size_t count() const { return static_cast<std::size_t>(columns()) * rows(); }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * columns() + column;
  }
  /// The pixels of a tile.
  PixelRect pixels(int column, int row) const { return pixels({column, row, column + 1, row + 1}); }
  /// The pixels of some columns and rows of tiles.
  PixelRect pixels(const PixelRect& tiles) const {
    return clip({tiles.u_begin * kTileWidth_px, tiles.v_begin * kTileHeight_px,
                 tiles.u_end * kTileWidth_px, tiles.v_end * kTileHeight_px},
                width_px, height_px);
  }
  /// Columns and rows of the tiles that hold a pixel of `pixels`.
  PixelRect tiles_of(const PixelRect& pixels) const {
    const PixelRect inside = clip(pixels, width_px, height_px);
    if (inside.empty()) return {};
    return {inside.u_begin / kTileWidth_px, inside.v_begin / kTileHeight_px,
            (inside.u_end - 1) / kTileWidth_px + 1, (inside.v_end - 1) / kTileHeight_px + 1};
  }
};

/// Calls action(u, v) for each of the `bits` of the tile with these pixels, row by row. Goes
/// through four rows at a time: a loop over each row's few bits would end too often.
template <class Action>
void for_bits(const TileBits& bits, const PixelRect& tile, const Action& action) {
  static_assert(kTileWidth_px == 16 && kTileHeight_px % 4 == 0);
  for (int row = 0; row < kTileHeight_px; row += 4) {
    std::uint64_t four = 0;
    for (int i = 3; i >= 0; --i) four = four << 16 | bits[row + i];
    for (; four != 0; four &= four - 1) {
      const int i = std::countr_zero(four);
      action(tile.u_begin + i % 16, tile.v_begin + row + i / 16);
    }
  }
}

inline TileGrid tiles_of(const Camera& camera) { return {camera.width_px, camera.height_px}; }

}  // namespace berth
