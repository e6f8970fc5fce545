#include "berth/distance/mean_direction/direction_blocks.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "berth/distance/depth_tile.hpp"
#include "berth/distance/grid.hpp"
#include "berth/distance/mean_direction/pixel_moments.hpp"
#include "berth/distance/metric.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/mean_direction/direction_blocks.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/mean_direction/direction_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

constexpr int kBlocks = DirectionBlocks::Chunk::kBlocks;

/// Sums over the pixels of each block: of their places (see PixelSums), and with the gap of their
/// depth to the block's least one, which keeps the differences of large numbers out. The latter are
/// lane by lane first, then one for each block.
struct BlockSums {
  alignas(64) std::int32_t count[kBlocks];
  alignas(64) std::int32_t u[kBlocks];
  alignas(64) std::int32_t uu[kBlocks];
  alignas(64) std::int32_t v[kBlocks];
  alignas(64) std::int32_t uv[kBlocks];
  alignas(64) std::int32_t vv[kBlocks];
  alignas(64) float gap[kBlocks * kLanes];
  alignas(64) float u_gap[kBlocks * kLanes];
  alignas(64) float v_gap[kBlocks * kLanes];
  alignas(64) float squared_gap[kBlocks * kLanes];
};

HWY_INLINE Lanes load_integers(const std::int32_t* x) {
  const hn::RebindToSigned<FloatTag> d;
  return hn::ConvertTo(FloatTag(), hn::Load(d, x));
}

/// Sums of neighbours, until one number for each block is left.
HWY_INLINE void add_up_lanes(float* sums) {
  const FloatTag d;
  for (int count = kBlocks * kLanes / 2; count >= kBlocks; count /= 2) {
    for (int i = 0; i < count; i += kLanes) {
      hn::Vec<FloatTag> even;
      hn::Vec<FloatTag> odd;
      hn::LoadInterleaved2(d, sums + 2 * i, even, odd);
      hn::Store(hn::Add(even, odd), d, sums + i);
    }
  }
}

/// The sums of one block in its own lanes; returns its pixels.
HWY_INLINE std::uint64_t sum_pixels(const TileDepths& tile, float lo_m, float hi_m, int block,
                                    BlockSums& sums) {
  Lanes gap(0);
  Lanes u_gap(0);
  Lanes v_gap(0);
  Lanes squared_gap(0);
  std::uint64_t pixels = 0;
  for (int i = 0; i < kTilePixels; i += kLanes) {
    const Lanes depth_m = load_tile(tile, i);
    const LaneMask within =
        hn::And(hn::Ge(depth_m.v, Lanes(lo_m).v), hn::Le(depth_m.v, Lanes(hi_m).v));
    const Lanes gap_m = zero_unless(within, depth_m - Lanes(lo_m));
    pixels |= bits_of(within) << i;
    gap = gap + gap_m;
    u_gap = multiply_add(gap_m, load(kTileGrid.column + i), u_gap);
    v_gap = multiply_add(gap_m, load(kTileGrid.row + i), v_gap);
    squared_gap = multiply_add(gap_m, gap_m, squared_gap);
  }
  store(gap, sums.gap + block * kLanes);
  store(u_gap, sums.u_gap + block * kLanes);
  store(v_gap, sums.v_gap + block * kLanes);
  store(squared_gap, sums.squared_gap + block * kLanes);
  return pixels;
}

/// From the sums to moments in frame C, for a vector of blocks. Products of a deviation in depth
/// and one across are left out.
HWY_INLINE void finish_blocks(const BasicMetric<Lanes>& metric, const BlockSums& sums, int i,
                              DirectionBlocks::Chunk& c) {
  const Lanes count = load_integers(sums.count + i);
  const Lanes inverse_count = hn::Div(Lanes(1).v, count.v);
  store(count, c.count + i);
  const Lanes gap_m = load(sums.gap + i) * inverse_count;
  const Lanes u_px = load_integers(sums.u + i) * inverse_count;
  const Lanes v_px = load_integers(sums.v + i) * inverse_count;
  const Lanes hi_m = load(c.depth_hi_m + i);
  const Lanes lo_m = load(c.depth_lo_m + i);
  const Lanes z_m = lo_m + gap_m;
  const Lanes tx = (load(c.u + i) + u_px - metric.cx_px) * metric.inv_fx;
  const Lanes ty = (load(c.v + i) + v_px - metric.cy_px) * metric.inv_fy;
  const Lanes txx =
      (load_integers(sums.uu + i) * inverse_count - u_px * u_px) * metric.inv_fx * metric.inv_fx;
  const Lanes txy =
      (load_integers(sums.uv + i) * inverse_count - u_px * v_px) * metric.inv_fx * metric.inv_fy;
  const Lanes tyy =
      (load_integers(sums.vv + i) * inverse_count - v_px * v_px) * metric.inv_fy * metric.inv_fy;
  // Covariances of depth with depth, and with the place across.
  const Lanes zz_m2 = positive_part(load(sums.squared_gap + i) * inverse_count - gap_m * gap_m);
  const Lanes zu_m = (load(sums.u_gap + i) * inverse_count - u_px * gap_m) * metric.inv_fx;
  const Lanes zv_m = (load(sums.v_gap + i) * inverse_count - v_px * gap_m) * metric.inv_fy;
  const Lanes gx_m2 = zu_m * z_m;
  const Lanes gy_m2 = zv_m * z_m;
  const Lanes squared_z_m2 = z_m * z_m;
  const Lanes xx_m2 = zz_m2 * tx * tx + Lanes(2) * tx * gx_m2 + txx * squared_z_m2;
  const Lanes yy_m2 = zz_m2 * ty * ty + Lanes(2) * ty * gy_m2 + tyy * squared_z_m2;
  store(multiply_add(tx, z_m, zu_m), c.x_m + i);
  store(multiply_add(ty, z_m, zv_m), c.y_m + i);
  store(z_m, c.z_m + i);
  store(xx_m2, c.xx_m2 + i);
  store(zz_m2 * tx * ty + tx * gy_m2 + ty * gx_m2 + txy * squared_z_m2, c.xy_m2 + i);
  store(zz_m2 * tx + gx_m2, c.xz_m2 + i);
  store(yy_m2, c.yy_m2 + i);
  store(zz_m2 * ty + gy_m2, c.yz_m2 + i);
  store(zz_m2, c.zz_m2 + i);

  const Lanes ray = hn::Sqrt((Lanes(1) + tx * tx + ty * ty).v);
  const Lanes across_x = (Lanes(3.5f) + absolute(u_px - Lanes(3.5f))) * metric.inv_fx;
  const Lanes across_y = (Lanes(3.5f) + absolute(v_px - Lanes(3.5f))) * metric.inv_fy;
  const Lanes across = hn::Sqrt((across_x * across_x + across_y * across_y).v);
  store(greatest(hi_m - z_m, z_m - lo_m) * ray + hi_m * across, c.reach_m + i);
  store(across, c.tangent_reach + i);
  store(tx, c.tangent_x + i);
  store(ty, c.tangent_y + i);
  store(txx, c.tangent_xx + i);
  store(txy, c.tangent_xy + i);
  store(tyy, c.tangent_yy + i);
}

/// Fills a chunk whose tiles and depth ranges are set.
void sum_up_chunk(const Metric& metric, const DepthView& obstacle_depth_m,
                  DirectionBlocks::Chunk& c) {
  BlockSums sums;
  TileCopy copy;
  for (int i = 0; i < kBlocks; ++i) {
    const TileDepths tile =
        tile_depths(obstacle_depth_m, static_cast<int>(c.u[i]), static_cast<int>(c.v[i]), copy);
    const std::uint64_t pixels = sum_pixels(tile, c.depth_lo_m[i], c.depth_hi_m[i], i, sums);
    const PixelSums places = pixel_sums(pixels);
    c.pixels[i] = pixels;
    sums.count[i] = places.count;
    sums.u[i] = places.u;
    sums.uu[i] = places.uu;
    sums.v[i] = places.v;
    sums.uv[i] = places.uv;
    sums.vv[i] = places.vv;
  }
  for (float* lanes : {sums.gap, sums.u_gap, sums.v_gap, sums.squared_gap}) add_up_lanes(lanes);
  for (int i = 0; i < kBlocks; i += kLanes) finish_blocks(broadcast(metric), sums, i, c);
}

/// The readings on both sides of the middle of a tile's depth range.
void find_edge(const TileDepths& tile, float middle_m, float& near_hi_m, float& far_lo_m) {
  Lanes near_m(-HUGE_VALF);
  Lanes far_m(HUGE_VALF);
  for (int i = 0; i < kTilePixels; i += kLanes) {
    const Lanes depth_m = load_tile(tile, i);
    const LaneMask is_near = hn::Le(depth_m.v, Lanes(middle_m).v);
    const LaneMask is_far = hn::Gt(depth_m.v, Lanes(middle_m).v);
    near_m = greatest(near_m, choose(is_near, depth_m, near_m));
    far_m = least(far_m, choose(is_far, depth_m, far_m));
  }
  near_hi_m = greatest_lane(near_m);
  far_lo_m = least_lane(far_m);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(sum_up_chunk);
HWY_EXPORT(find_edge);

namespace {

using Chunk = DirectionBlocks::Chunk;

/// A tile whose depth range is more than this part of its depth has an edge.
constexpr float kEdge = 0.05f;

class Builder {
 public:
  Builder(DepthView obstacle_depth_m, DirectionBlocks& blocks)
      : obstacle_depth_m_(obstacle_depth_m), blocks_(blocks) {}

  void add_tile(int u, int v, float lo_m, float hi_m) {
    if (!(hi_m - lo_m > kEdge * lo_m)) {
      add_block(u, v, lo_m, hi_m);
      return;
    }
    float near_hi_m = 0;
    float far_lo_m = 0;
    TileCopy copy;
    HWY_DYNAMIC_DISPATCH(find_edge)
    (tile_depths(obstacle_depth_m_, u, v, copy), 0.5f * (lo_m + hi_m), near_hi_m, far_lo_m);
    add_block(u, v, lo_m, near_hi_m);
    add_block(u, v, far_lo_m, hi_m);
  }

  /// Fills what is left of the last chunk. Returns how many blocks of it are there.
  int finish() {
    if (used_ == 0) return Chunk::kBlocks;
    Chunk& last = blocks_.chunks[blocks_.chunk_count];
    const int used = used_;
    // Copies, so that their numbers are finite.
    while (used_ > 0) {
      add_block(static_cast<int>(last.u[0]), static_cast<int>(last.v[0]), last.depth_lo_m[0],
                last.depth_hi_m[0]);
    }
    return used;
  }

 private:
  void add_block(int u, int v, float lo_m, float hi_m) {
    Chunk& chunk = blocks_.chunks[blocks_.chunk_count];
    chunk.u[used_] = static_cast<float>(u);
    chunk.v[used_] = static_cast<float>(v);
    chunk.depth_lo_m[used_] = lo_m;
    chunk.depth_hi_m[used_] = hi_m;
    if (++used_ < Chunk::kBlocks) return;
    used_ = 0;
    ++blocks_.chunk_count;
  }

  DepthView obstacle_depth_m_;
  DirectionBlocks& blocks_;
  int used_ = 0;
};

}  // namespace

void build_direction_blocks(const Camera& camera, const SearchableDepth& obstacles,
                            const PixelRect& rect, float max_depth_m, DirectionBlocks& blocks) {
  const DepthView obstacle_depth_m = obstacles.depth_m();
  const ObstacleTree::Level& level = obstacles.tree().levels[0];
  const int tiles = static_cast<int>(level.nodes.size()) * ObstacleTree::kChildren;
  // Each tile makes two blocks at most.
  blocks.chunks.resize(2 * tiles / Chunk::kBlocks + 1);
  blocks.chunk_count = 0;
  Builder builder(obstacle_depth_m, blocks);
  for (int tile = 0; tile < tiles; ++tile) {
    const int n = tile / ObstacleTree::kChildren;
    const int c = tile % ObstacleTree::kChildren;
    const int u = (4 * (n % level.columns) + c % 4) * kTilePx;
    const int v = (4 * (n / level.columns) + c / 4) * kTilePx;
    const float lo_m = level.nodes[n].depth_lo_m[c];
    if (!(lo_m <= max_depth_m) || u >= rect.u_end || v >= rect.v_end ||
        u + kTilePx <= rect.u_begin || v + kTilePx <= rect.v_begin) {
      continue;
    }
    builder.add_tile(u, v, lo_m, level.nodes[n].depth_hi_m[c]);
  }
  const int last_blocks = builder.finish();

  const Metric metric = metric_of(camera);
  const auto sum_up = HWY_DYNAMIC_DISPATCH(sum_up_chunk);
  tbb::parallel_for(tbb::blocked_range<int>(0, blocks.chunk_count, 16),
                    [&](const tbb::blocked_range<int>& range) {
                      for (int i = range.begin(); i < range.end(); ++i)
                        sum_up(metric, obstacle_depth_m, blocks.chunks[i]);
                    });
  if (blocks.chunk_count == 0) return;
  // Nobody shall see the blocks that only fill the last chunk.
  Chunk& last = blocks.chunks[blocks.chunk_count - 1];
  std::fill(last.depth_lo_m + last_blocks, last.depth_lo_m + Chunk::kBlocks, kNoDepth);
  std::fill(last.depth_hi_m + last_blocks, last.depth_hi_m + Chunk::kBlocks, kNoDepth);
}

}  // namespace berth
#endif  // HWY_ONCE
