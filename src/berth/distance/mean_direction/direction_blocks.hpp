#pragma once

#include <cstdint>
#include <vector>

#include "berth/distance/searchable_depth.hpp"
#include "berth/types/camera.hpp"

namespace berth {

/// The obstacle readings of an image in blocks: the readings of one tile of the tree, or, where the
/// tile holds a depth edge, those before and those behind it. Each block is known by its moments,
/// so that far away it can stand for its pixels.
struct DirectionBlocks {
  /// Blocks that lie side by side, so that a vector takes them at once. A lane without a block has
  /// NaN for its depth range, and elsewhere finite numbers without a meaning.
  struct Chunk {
    static constexpr int kBlocks = 16;

    /// The tile's first pixel.
    alignas(64) float u[kBlocks];
    alignas(64) float v[kBlocks];
    alignas(64) float count[kBlocks];
    alignas(64) float depth_lo_m[kBlocks];
    alignas(64) float depth_hi_m[kBlocks];
    /// The mean of the readings' points in frame C, each at the upper left corner of its pixel.
    alignas(64) float x_m[kBlocks];
    alignas(64) float y_m[kBlocks];
    alignas(64) float z_m[kBlocks];
    /// The covariance of these points.
    alignas(64) float xx_m2[kBlocks];
    alignas(64) float xy_m2[kBlocks];
    alignas(64) float xz_m2[kBlocks];
    alignas(64) float yy_m2[kBlocks];
    alignas(64) float yz_m2[kBlocks];
    alignas(64) float zz_m2[kBlocks];
    /// No point is further from the mean.
    alignas(64) float reach_m[kBlocks];
    /// Mean, covariance and reach of the pixels' corners alone, at depth 1.
    alignas(64) float tangent_x[kBlocks];
    alignas(64) float tangent_y[kBlocks];
    alignas(64) float tangent_xx[kBlocks];
    alignas(64) float tangent_xy[kBlocks];
    alignas(64) float tangent_yy[kBlocks];
    alignas(64) float tangent_reach[kBlocks];
    /// The tile's pixels that belong to the block (see tile_bits.hpp).
    std::uint64_t pixels[kBlocks];
  };

  std::vector<Chunk> chunks;
  /// The chunks in use; the rest is spare.
  int chunk_count = 0;
};

/// Sums up the tiles of the tree that have a pixel in the rectangle and a reading no deeper than
/// max_depth_m; reuses the blocks' memory.
void build_direction_blocks(const Camera& camera, const SearchableDepth& obstacles,
                            const PixelRect& rect, float max_depth_m, DirectionBlocks& blocks);

}  // namespace berth
