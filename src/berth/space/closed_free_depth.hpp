// Free depth beyond what is too small to hide anybody.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/depth_units.hpp"

namespace berth {

/// The memory of close_free_depth().
struct ClosingWorkspace {
  /// The size of the images that it was made for.
  int width = 0;
  int height = 0;
  /// Depths, with zeros around the image.
  std::vector<DepthUnits> rows;
  /// The rows that are being worked on.
  std::vector<DepthUnits> rings;
};

/// Discs that a ball covers wherever its centre lies: all blocks of side_px x side_px pixels, that
/// begin at whole multiples of it, within this number of blocks of some block.
struct ClosingTier {
  int side_px;
  int radius_blocks;
  /// The least radius in pixels of a ball that does.
  double least_radius_px() const;
  /// How far the pixels of such a ball are from the middle of the block, at most.
  double reach_px() const;
};

/// The greatest first.
inline constexpr std::array<ClosingTier, 4> kClosingTiers = {{{2, 2}, {2, 1}, {1, 2}, {1, 1}}};

/// Raises what a pixel frees (`own`, as of find_own_free_depth()) where no ball of the diameter
/// d = `detection_capability_m` could stand that this camera would have missed.
///
/// A ball at the depth l covers the pixels in a disc of the radius r = f d / 2 l, f being the
/// lesser focal length, wherever its centre lies between the pixels' centres. It may stand there
/// unseen only if each of them frees l at most; then all pixels of the greatest tier do that has
/// least_radius_px() <= r, around some block that the ball's pixels are within reach_px() of. Below
/// all tiers a ball covers two neighbours (4) at least, while r >= 1; beyond that depth nothing is
/// known. A pixel frees the least l at which it may be part of a ball, less d / 2, if that is more
/// than `own`; all in units, d / 2 rounded up. Beside the image nothing is free: a ball may stand
/// half in it. Off where d is 0.
void close_free_depth(const Camera& camera, double detection_capability_m,
                      ClosingWorkspace& workspace, UnitImage& own);

}  // namespace berth
