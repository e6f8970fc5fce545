#include "berth/distance/mean_direction/direction_sum.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/mean_direction/direction_sum.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/mean_direction/direction_block_sum-inl.hpp"
#include "berth/distance/mean_direction/direction_pixel_sum-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

HWY_INLINE Start broadcast(const DirectionSum& sum, const DepthView& obstacle_depth_m) {
  PixelRect rect = sum.rect;
  const bool is_cut = rect != PixelRect{0, 0, obstacle_depth_m.width, obstacle_depth_m.height};
  // The last tiles reach beyond the image, where nothing is.
  if (rect.u_end == obstacle_depth_m.width) rect.u_end += kTilePx;
  if (rect.v_end == obstacle_depth_m.height) rect.v_end += kTilePx;
  return {Lanes(sum.u), Lanes(sum.v), Lanes(sum.depth_m), Lanes(sum.max_depth_m), rect, is_cut};
}

/// The blocks of a chunk whose bits are set, pixel by pixel.
LaneSums sum_pixels_of_blocks(const BasicMetric<Lanes>& metric, const Start& start,
                              const DepthView& obstacle_depth_m, const Chunk& c,
                              std::uint64_t blocks) {
  LaneSums sums = no_directions();
  TileCopy copy;
  const float robot_u = hn::GetLane(start.u.v);
  const float robot_v = hn::GetLane(start.v.v);
  for (; blocks != 0; blocks &= blocks - 1) {
    const int i = std::countr_zero(blocks);
    const int u = static_cast<int>(c.u[i]);
    const int v = static_cast<int>(c.v[i]);
    const std::uint64_t pixels =
        c.pixels[i] & pixels_within(start.rect.u_begin - u, start.rect.v_begin - v,
                                    start.rect.u_end - u, start.rect.v_end - v);
    const TileDepths tile = tile_depths(obstacle_depth_m, u, v, copy);
    const bool may_touch =
        std::abs(robot_u - c.u[i] - 3.5f) < 5 && std::abs(robot_v - c.v[i] - 3.5f) < 5;
    if (may_touch) {
      add_pixels<true>(metric, start, tile, pixels, Lanes(c.u[i]), Lanes(c.v[i]), sums);
    } else {
      add_pixels<false>(metric, start, tile, pixels, Lanes(c.u[i]), Lanes(c.v[i]), sums);
    }
  }
  return sums;
}

/// So few chunks that they stay in the cache until all links have seen them, and that sums in float
/// are good.
constexpr int kChunksAtOnce = 12;

void add_chunks(const Metric& metric, const DepthView& obstacle_depth_m, const Chunk* begin,
                const Chunk* end, float max_error, DirectionSum& sum) {
  const BasicMetric<Lanes> metrics = broadcast(metric);
  const Start start = broadcast(sum, obstacle_depth_m);
  LaneSums sums = no_directions();
  for (const Chunk* c = begin; c != end; ++c) {
    std::uint64_t near = 0;
    for (int i = 0; i < Chunk::kBlocks; i += kLanes) {
      near |= add_blocks(metrics, start, Lanes(max_error), *c, i, sums) << i;
    }
    if (near == 0) continue;
    const LaneSums more = sum_pixels_of_blocks(metrics, start, obstacle_depth_m, *c, near);
    sums.x = sums.x + more.x;
    sums.y = sums.y + more.y;
    sums.z = sums.z + more.z;
    sums.pixels += more.pixels;
  }
  sum.x += sum_of_lanes(sums.x);
  sum.y += sum_of_lanes(sums.y);
  sum.z += sum_of_lanes(sums.z);
  sum.count += sum_of_lanes(sums.count) + static_cast<double>(sums.pixels);
  sum.error += sum_of_lanes(sums.error);
}

void add_all_chunks(const Metric& metric, const DepthView& obstacle_depth_m,
                    const DirectionBlocks& blocks, float max_error, DirectionSum* sums,
                    int sum_count) {
  const Chunk* const chunks = blocks.chunks.data();
  for (int begin = 0; begin < blocks.chunk_count; begin += kChunksAtOnce) {
    const int end = std::min(begin + kChunksAtOnce, blocks.chunk_count);
    for (int i = 0; i < sum_count; ++i) {
      if (sums[i].is_done) continue;
      add_chunks(metric, obstacle_depth_m, chunks + begin, chunks + end, max_error, sums[i]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(add_all_chunks);

namespace {

/// Empties the sum unless its mean is good enough.
void judge(float max_error, DirectionSum& sum) {
  sum.is_done = sum.is_done || sum.error <= max_error * sum.count;
  if (!sum.is_done) sum.x = sum.y = sum.z = sum.count = sum.error = 0;
}

}  // namespace

void sum_directions(const Metric& metric, DepthView obstacle_depth_m, const DirectionBlocks& blocks,
                    float max_error, DirectionSum* sums, int sum_count) {
  const auto add_chunks_of = HWY_DYNAMIC_DISPATCH(add_all_chunks);
  const auto add = [&](float block_error) {
    tbb::parallel_for(tbb::blocked_range<int>(0, sum_count),
                      [&](const tbb::blocked_range<int>& range) {
                        add_chunks_of(metric, obstacle_depth_m, blocks, block_error,
                                      sums + range.begin(), static_cast<int>(range.size()));
                      });
  };
  // Few blocks are near, so that a larger error of theirs does little to the mean.
  for (const float factor : {15.0f, 4.0f}) {
    add(factor * max_error);
    for (int i = 0; i < sum_count; ++i) judge(max_error, sums[i]);
  }
  // What no block exceeds, the mean does not exceed.
  add(max_error);
}

}  // namespace berth
#endif  // HWY_ONCE
