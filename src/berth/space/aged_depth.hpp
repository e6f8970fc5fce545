// Free space that is left after something may have moved.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "berth/space/depth_windows.hpp"
#include "berth/types/camera.hpp"

namespace berth {

/// The memory of age_free_depth().
struct AgingWorkspace {
  /// Some columns of a row.
  struct Part {
    int begin = 0;
    int end = 0;

    bool is_empty() const { return end <= begin; }
  };
  /// The same in blocks of columns.
  struct Blocks {
    std::int16_t begin = 0;
    std::int16_t end = 0;
  };
  /// The image, or what reaches far in it, in pixels of twice the side of those of the level
  /// before.
  struct Level {
    /// S, what is left, and what of it holds; not used for the image itself.
    UnitImage sensor_depth;
    UnitImage left;
    UnitImage held;
    /// Bit r of a block of a row: some pixel may be of ring r. Row by row.
    std::vector<std::uint32_t> rings;
    /// Of each row those blocks that have pixels of a ring, ring by ring.
    std::vector<Blocks> ring_blocks;
  };

  static constexpr int kMostLevels = 24;
  std::array<Level, kMostLevels> levels;
  /// Three rows of each ring, and a row to work on.
  std::vector<DepthUnits> rows;
  /// What of each of them is touched.
  std::vector<Part> parts;
  /// Two rows of what reaches far.
  std::array<std::vector<DepthUnits>, 2> far;
  /// S and D1 of an image with environment in it.
  UnitImage sensor_depth;
  UnitImage own;
};

/// E after something may have moved by `moved_m`: each pixel has that much less left, rounded up to
/// units, unless nothing ends it; and what a pixel with a reading S has left holds for all that are
/// no more than r = ceil(f moved_m / S) pixels from it sideways, f the greater of both focal
/// lengths and S rounded down to units. Of that, the least of 3 x 3 pixels is free
/// (find_free_depth), so that it holds up to r + 1 pixels away.
///
/// Pixels with r + 1 above 25 are taken together in blocks of 2 x 2: the least that they have
/// left, and the least of their S. It holds for all blocks that are no more than (r + 1) / 2 from
/// it, rounded up. Blocks for which that is above 25 are taken together in the same way, and so on.
/// So it holds farther than it has to: by less than 2 blocks for a pixel alone, and by more where a
/// block holds pixels of different reach.
///
/// Nothing comes out of a solid: a pixel that frees more than its reading, and that reaches the
/// environment's front in all of 3 x 3 pixels, has at least that front left, and holds for itself
/// alone. `solid_to_end` is kEndlessUnits less that front, 0 where one of the pixels shows no
/// environment (DepthCeiling::left); null where there is no environment.
void age_free_depth(const Camera& camera, const UnitImage& sensor_depth, const UnitImage& own,
                    const DepthWindows* solid_to_end, double moved_m, AgingWorkspace& workspace,
                    DepthWindows& out);

// For age_free_depth() alone: what the pixels of one level hold, ring by ring.

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
