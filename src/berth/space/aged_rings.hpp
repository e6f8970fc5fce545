// What the pixels of one level of ageing hold (aged_depth.hpp), ring by ring.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "berth/space/aged_depth.hpp"

namespace berth {

/// Pixels of a greater ring reach far: they are taken together.
inline constexpr int kMostRing = 24;

/// A reading below the first r of these is of ring r at least; kMostRing + 1 stands for all beyond.
using RingBorders = std::array<DepthUnits, kMostRing + 1>;

/// A pixel that holds up to r + 1 pixels away, in pixels of this side q + 1 or more of them, is of
/// ring q: r >= side q, or S < f moved / (side q - 1). `spread_m` is f moved.
RingBorders ring_borders(double spread_m, int side_px);

/// What one level is made of.
struct LevelImages {
  const UnitImage& sensor_depth;
  const UnitImage& own;
  DepthUnits moved;
  RingBorders borders;
  /// What the level beyond holds, if there is one.
  const UnitImage* beyond;
  bool is_image;
};

/// Which rings occur in each block of each row (AgingWorkspace::Level::rings), and whether some
/// pixels reach far.
bool find_rings(const LevelImages& images, std::vector<std::uint32_t>& rings);

/// Whether some pixels of this row reach far, after find_rings().
bool reaches_far(const LevelImages& images, const std::vector<std::uint32_t>& rings, int v);

/// Writes what holds at each pixel of this level, row after row, after find_rings().
void hold_rings(const LevelImages& images, AgingWorkspace::Level& level, AgingWorkspace& workspace,
                DepthUnits* out);

/// `own` less `moved`; nothing ends what had no end.
inline DepthUnits left_of(DepthUnits own, DepthUnits moved) {
  if (own == kEndlessUnits) return own;
  return static_cast<DepthUnits>(own > moved ? own - moved : 0);
}

}  // namespace berth
