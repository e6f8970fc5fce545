// Inside self_filter/ only: the image cut into tiles, the unit of its work on several threads.
#pragma once

#include <cstddef>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"

namespace berth {

inline constexpr int kTileWidth_px = 16;
inline constexpr int kTileHeight_px = 8;

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
  PixelRect pixels(int column, int row) const {
    return clip({column * kTileWidth_px, row * kTileHeight_px, (column + 1) * kTileWidth_px,
                 (row + 1) * kTileHeight_px},
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

inline TileGrid tiles_of(const Camera& camera) { return {camera.width_px, camera.height_px}; }

}  // namespace berth
