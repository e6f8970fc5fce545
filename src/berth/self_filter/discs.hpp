// Inside self_filter/ only: which pixels the discs around the robot's outline cover, in vectors.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/self_filter/tiles.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// The pixels around an outline pixel that its growth reaches, a circle or an ellipse: those with
/// du^2 + squash dv^2 <= radius2_px2. A reading there belongs to the robot from least_m on.
struct Disc {
  float u_px;
  float v_px;
  float least_m;
  double radius2_px2;
  double squash;
};

/// The discs of the outline pixels in one tile.
struct DiscTile {
  /// Around the outline pixels.
  PixelRect bounds;
  /// No disc reaches farther, and no nearer reading belongs to one.
  float reach_px = 0;
  float least_m = 0;
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
};

/// What disc growth reads and writes.
struct GrownImages {
  DepthView sensor_depth_m;
  Image<PixelFate>& fate;
  DepthImage& obstacle_depth_m;
};

/// Whether there are obstacles or edges within `pixels`.
bool may_be_covered(const PixelRect& pixels, const Image<PixelFate>& fate);

/// Gives those obstacles and edges within `pixels` that belong to a disc the fate `grown`. Fastest
/// if the nearest tiles come first.
void cover_with_discs(const PixelRect& pixels, const std::vector<NearDiscTile>& tiles,
                      PixelFate grown, const GrownImages& images);

}  // namespace berth
