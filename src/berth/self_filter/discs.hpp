// Inside self_filter/ only: which pixels the discs around the robot's outline cover, in vectors.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/self_filter/tiles.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// A reading of z metres is on a surface if at least so many of its eight neighbours differ from it
/// by at most kSurfaceJump_m max(1, z^2). A mixed pixel is not: its neighbours lie before or
/// behind.
inline constexpr int kLeastOnSurface = 5;
inline constexpr float kSurfaceJump_m = 0.03F;

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
  float reach_px = 0;
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
};

/// What disc growth reads and writes.
struct GrownImages {
  DepthView sensor_depth_m;
  Image<PixelFate>& fate;
  DepthImage& obstacle_depth_m;
};

/// Whether there are obstacles or edges within `pixels`.
bool may_be_covered(const PixelRect& pixels, const Image<PixelFate>& fate);

/// Gives those obstacles, and unless they become islands those edges, within `pixels` that belong to a disc the fate `grown`. Fastest
/// if the nearest tiles come first.
void cover_with_discs(const PixelRect& pixels, const std::vector<NearDiscTile>& tiles,
                      PixelFate grown, const GrownImages& images);

}  // namespace berth
