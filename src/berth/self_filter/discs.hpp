// Inside self_filter/ only: which pixels the discs around the robot's outline cover, in vectors.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "berth/self_filter/tiles.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// A reading of z metres is on a surface if at least this number of its eight neighbours differ
/// from it by at most joined_step_m(z). A mixed pixel is not: its neighbours lie before or behind.
inline constexpr int kLeastOnSurface = 5;

/// The pixels around an outline pixel that its growth reaches, a circle or an ellipse: those with
/// du^2 + squash dv^2 <= radius2_px2. A reading there belongs to the robot from least_m to most_m,
/// and beyond most_m where it is on no surface.
struct Disc {
  float u_px;
  float v_px;
  float least_m;
  float most_m;
  double radius2_px2;
  double squash;
};

/// The discs of the outline pixels in one tile.
struct DiscTile {
  /// Around the outline pixels.
  PixelRect bounds;
  /// No disc reaches farther, and no nearer reading belongs to one, nor one that is farther away
  /// and on a surface.
  int reach_px = -1;
  int reach2_px2 = -1;
  float least_m = 0;
  float most_m = 0;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// A tile of discs that reaches into another tile.
struct NearDiscTile {
  /// Between the outline pixels and the other tile.
  int distance2_px2;
  const DiscTile* tile;
  /// The first of its discs.
  const Disc* discs;

  /// Those rows of the other tile that its discs may reach.
  std::pair<int, int> rows(const PixelRect& other) const {
    return {std::max(other.v_begin, tile->bounds.v_begin - tile->reach_px),
            std::min(other.v_end, tile->bounds.v_end + tile->reach_px)};
  }
};

/// Whether there are obstacles within `pixels`.
bool may_be_covered(const PixelRect& pixels, const Image<PixelFate>& fate);

/// Which obstacles of the tile with these pixels belong to a disc. Fastest if the nearest
/// tiles come first.
TileBits covered_by_discs(const PixelRect& pixels, const std::vector<NearDiscTile>& tiles,
                          DepthView sensor_depth_m, const Image<PixelFate>& fate);

}  // namespace berth
