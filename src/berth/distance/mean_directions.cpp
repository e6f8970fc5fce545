#include "berth/distance/mean_directions.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#ifndef BERTH_MEAN_DIRECTIONS_SUMS
#define BERTH_MEAN_DIRECTIONS_SUMS
namespace berth {
/// What a tile's readings add up to; u and v count from the tile's first pixel.
struct TileSum {
  float count = 0;
  float z = 0;
  float uz = 0;
  float vz = 0;
  float least_z = 0;
  float greatest_z = 0;
};
/// Unit vectors in frame C.
struct DirectionTotal {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double count = 0;
};
}  // namespace berth
#endif

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/mean_directions.cpp"
#include "hwy/foreach_target.h"

#include "berth/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

constexpr int kReadingTilePx = ReadingTiles::kTilePx;
constexpr int kReadingTilePixels = kReadingTilePx * kReadingTilePx;

/// Some of a tile's pixels: where they lie in it, and their depths.
struct TilePixels {
  Lanes u, v, z;
  LaneMask has_reading;
};

/// The depths of a tile, NaN beyond the image's end.
struct TileDepths {
  alignas(64) float depth_m[kReadingTilePixels];

  HWY_INLINE TileDepths(const DepthView& image_m, Pixel corner) {
    const int width = std::min(kReadingTilePx, image_m.width - corner.u);
    const int height = std::min(kReadingTilePx, image_m.height - corner.v);
    if (width < kReadingTilePx || height < kReadingTilePx)
      std::fill_n(depth_m, kReadingTilePixels, kNoDepth);
    for (int v = 0; v < height; ++v) {
      std::memcpy(depth_m + kReadingTilePx * v, image_m.row(corner.v + v) + corner.u,
                  sizeof(float) * width);
    }
  }
  HWY_INLINE TilePixels pixels(int first) const {
    const Lanes place = count_up(static_cast<float>(first));
    const Lanes v = hn::Floor((place * Lanes(1.0f / kReadingTilePx)).v);
    const Lanes z = load(depth_m + first);
    return {place - v * Lanes(kReadingTilePx), v, z, hn::Eq(z.v, z.v)};
  }
};

HWY_INLINE Lanes where(LaneMask mask, Lanes x) { return hn::IfThenElseZero(mask, x.v); }

TileSum sum_of_tile(const DepthView& depth_m, Pixel corner) {
  const TileDepths tile(depth_m, corner);
  Lanes count(0.0f), sum_z(0.0f), sum_uz(0.0f), sum_vz(0.0f), least_z(HUGE_VALF), greatest_z(0.0f);
  for (int i = 0; i < kReadingTilePixels; i += kLanes) {
    const TilePixels pixels = tile.pixels(i);
    const Lanes z = where(pixels.has_reading, pixels.z);
    count = count + where(pixels.has_reading, Lanes(1.0f));
    sum_z = sum_z + z;
    sum_uz = mul_add(pixels.u, z, sum_uz);
    sum_vz = mul_add(pixels.v, z, sum_vz);
    least_z = least(least_z, nan_to_infinity(pixels.z));
    greatest_z = greatest(greatest_z, z);
  }
  return {sum_of_lanes(count),  sum_of_lanes(sum_z), sum_of_lanes(sum_uz),
          sum_of_lanes(sum_vz), least_lane(least_z), greatest_lane(greatest_z)};
}

/// Sums of what lies on all lanes.
struct LaneSums {
  Lanes x, y, z, count;

  /// Ways with their squares, each as often as its weight says.
  HWY_INLINE void add(Lanes way_x, Lanes way_y, Lanes way_z, Lanes square, Lanes weight) {
    const Lanes scale = weight / root(greatest(square, Lanes(1e-12f)));
    x = mul_add(way_x, scale, x);
    y = mul_add(way_y, scale, y);
    z = mul_add(way_z, scale, z);
    count = count + weight;
  }
};

/// A tile that is near, pixel by pixel.
HWY_INLINE void add_pixels(const DirectionCamera& view, Pixel corner, const Eigen::Vector3f& p,
                           Lanes range2, LaneSums& sums) {
  const Camera& camera = view.camera;
  const TileDepths tile(view.obstacle_depth_m, corner);
  const Lanes du(static_cast<float>(1 / camera.fx_px)), dv(static_cast<float>(1 / camera.fy_px));
  const Lanes u0(static_cast<float>((corner.u - camera.cx_px) / camera.fx_px));
  const Lanes v0(static_cast<float>((corner.v - camera.cy_px) / camera.fy_px));
  for (int i = 0; i < kReadingTilePixels; i += kLanes) {
    const TilePixels pixels = tile.pixels(i);
    const Lanes depth = where(pixels.has_reading, pixels.z);
    const Lanes x = mul_add(pixels.u, du, u0) * depth - Lanes(p.x());
    const Lanes y = mul_add(pixels.v, dv, v0) * depth - Lanes(p.y());
    const Lanes z = depth - Lanes(p.z());
    const Lanes square = mul_add(x, x, mul_add(y, y, z * z));
    const LaneMask counts = both(pixels.has_reading, both(square <= range2, square > Lanes(0.0f)));
    sums.add(x, y, z, square, where(counts, Lanes(1.0f)));
  }
}

DirectionTotal sum_of_view(const DirectionCamera& view, const Eigen::Vector3f& p, float range_m) {
  constexpr float kNearest = 0.25F;
  const ReadingTiles& tiles = view.tiles;
  const Lanes range2(range_m * range_m);
  const Lanes none(0.0f);
  LaneSums sums{none, none, none, none};
  for (std::size_t first = 0; first < tiles.count.size(); first += kLanes) {
    const Lanes x = load(&tiles.x_m[first]) - Lanes(p.x());
    const Lanes y = load(&tiles.y_m[first]) - Lanes(p.y());
    const Lanes z = load(&tiles.z_m[first]) - Lanes(p.z());
    const Lanes count = load(&tiles.count[first]);
    const Lanes radius = load(&tiles.radius_m[first]);
    const Lanes square = mul_add(x, x, mul_add(y, y, z * z));
    const Lanes reach = radius + Lanes(range_m);
    const LaneMask in_reach = both(count > Lanes(0.0f), square <= reach * reach);
    if (bits_of(in_reach) == 0) continue;
    const Lanes near = radius * Lanes(1 / kNearest);
    const LaneMask is_near = square < near * near;
    const LaneMask is_far = hn::AndNot(is_near, square <= range2);
    sums.add(x, y, z, square, where(is_far, count));
    for (std::uint64_t bits = bits_of(both(is_near, in_reach)); bits != 0; bits &= bits - 1)
      add_pixels(view, tiles.corner[first + __builtin_ctzll(bits)], p, range2, sums);
  }
  return {{sum_of_lanes(sums.x), sum_of_lanes(sums.y), sum_of_lanes(sums.z)},
          sum_of_lanes(sums.count)};
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(sum_of_tile);
HWY_EXPORT(sum_of_view);

namespace {

/// The most lanes that a vector has.
constexpr int kTilesAtOnce = 16;

Eigen::Vector3f point_C_m(const Camera& camera, double u, double v, double z) {
  return Eigen::Vector3d((u - camera.cx_px) * z / camera.fx_px,
                         (v - camera.cy_px) * z / camera.fy_px, z)
      .cast<float>();
}

/// The farthest corner of the tile's box of pixels and depths.
float radius_m(const Camera& camera, const PixelRect& rect, const TileSum& sum,
               const Eigen::Vector3f& mean_C_m) {
  float square_m2 = 0;
  for (const int u : {rect.u_begin, rect.u_end - 1}) {
    for (const int v : {rect.v_begin, rect.v_end - 1}) {
      for (const float z : {sum.least_z, sum.greatest_z}) {
        square_m2 = std::max(square_m2, (point_C_m(camera, u, v, z) - mean_C_m).squaredNorm());
      }
    }
  }
  return std::sqrt(square_m2);
}

void add_tile(const Camera& camera, const PixelRect& rect, const TileSum& sum, ReadingTiles& out) {
  const float mean_z = sum.z / sum.count;
  const Eigen::Vector3f mean_C_m(
      static_cast<float>((sum.uz + (rect.u_begin - camera.cx_px) * sum.z) / camera.fx_px) /
          sum.count,
      static_cast<float>((sum.vz + (rect.v_begin - camera.cy_px) * sum.z) / camera.fy_px) /
          sum.count,
      mean_z);
  out.count.push_back(sum.count);
  out.x_m.push_back(mean_C_m.x());
  out.y_m.push_back(mean_C_m.y());
  out.z_m.push_back(mean_C_m.z());
  out.radius_m.push_back(radius_m(camera, rect, sum, mean_C_m));
  out.corner.push_back({rect.u_begin, rect.v_begin});
}

}  // namespace

void build_reading_tiles(const Camera& camera, DepthView obstacle_depth_m, ReadingTiles& out) {
  for (auto* numbers : {&out.count, &out.x_m, &out.y_m, &out.z_m, &out.radius_m}) numbers->clear();
  out.corner.clear();
  constexpr int kPx = ReadingTiles::kTilePx;
  for (int v = 0; v < obstacle_depth_m.height; v += kPx) {
    for (int u = 0; u < obstacle_depth_m.width; u += kPx) {
      const PixelRect rect =
          clip({u, v, u + kPx, v + kPx}, obstacle_depth_m.width, obstacle_depth_m.height);
      const TileSum sum = HWY_DYNAMIC_DISPATCH(sum_of_tile)(obstacle_depth_m, {u, v});
      if (sum.count > 0) add_tile(camera, rect, sum, out);
    }
  }
  while (out.count.size() % kTilesAtOnce != 0) {
    for (auto* numbers : {&out.count, &out.x_m, &out.y_m, &out.z_m, &out.radius_m}) {
      numbers->push_back(0);
    }
    out.corner.push_back({});
  }
}

MeanDirection mean_direction(std::span<const DirectionCamera> views, const Eigen::Vector3d& p_B_m,
                             double range_m) {
  DirectionTotal all;
  for (const DirectionCamera& view : views) {
    const Eigen::Vector3f p_C_m = (view.X_BC.inverse() * p_B_m).cast<float>();
    const DirectionTotal sum =
        HWY_DYNAMIC_DISPATCH(sum_of_view)(view, p_C_m, static_cast<float>(range_m));
    all.direction += view.X_BC.linear() * sum.direction;
    all.count += sum.count;
  }
  MeanDirection mean;
  mean.count = static_cast<std::int64_t>(std::lround(all.count));
  mean.direction_B = (all.direction / all.count).cast<float>();
  return mean;
}

}  // namespace berth
#endif  // HWY_ONCE
