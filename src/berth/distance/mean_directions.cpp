#include "berth/distance/mean_directions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace berth {
namespace {

constexpr int kTilesAtOnce = 8;
constexpr float kNearest = 0.25F;

/// What a tile's readings add up to.
struct TileSum {
  float count = 0;
  float z = 0;
  float uz = 0;
  float vz = 0;
  float least_z = std::numeric_limits<float>::infinity();
  float greatest_z = 0;
};

TileSum sum_of(const DepthView& depth_m, const PixelRect& rect) {
  TileSum sum;
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    const float* row = depth_m.row(v);
    for (int u = rect.u_begin; u < rect.u_end; ++u) {
      const float z = row[u];
      if (std::isnan(z)) continue;
      sum.count += 1;
      sum.z += z;
      sum.uz += static_cast<float>(u) * z;
      sum.vz += static_cast<float>(v) * z;
      sum.least_z = std::min(sum.least_z, z);
      sum.greatest_z = std::max(sum.greatest_z, z);
    }
  }
  return sum;
}

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
      static_cast<float>((sum.uz - camera.cx_px * sum.z) / camera.fx_px) / sum.count,
      static_cast<float>((sum.vz - camera.cy_px * sum.z) / camera.fy_px) / sum.count, mean_z);
  out.count.push_back(sum.count);
  out.x_m.push_back(mean_C_m.x());
  out.y_m.push_back(mean_C_m.y());
  out.z_m.push_back(mean_C_m.z());
  out.radius_m.push_back(radius_m(camera, rect, sum, mean_C_m));
  out.corner.push_back({rect.u_begin, rect.v_begin});
}

/// Sums by lane, so that a compiler may take them side by side.
struct LaneSums {
  std::array<float, kTilesAtOnce> x{}, y{}, z{}, count{};
};

struct Sum {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double count = 0;
};

void add_far_tiles(const ReadingTiles& tiles, std::size_t first, const Eigen::Vector3f& p,
                   float range2_m2, LaneSums& sums, std::array<bool, kTilesAtOnce>& is_near) {
  for (int i = 0; i < kTilesAtOnce; ++i) {
    const std::size_t k = first + i;
    const float x = tiles.x_m[k] - p.x(), y = tiles.y_m[k] - p.y(), z = tiles.z_m[k] - p.z();
    const float square = x * x + y * y + z * z;
    const bool within = square <= range2_m2;
    const float least = tiles.radius_m[k] / kNearest;
    is_near[i] = square < least * least;
    const float weight = within && !is_near[i] ? tiles.count[k] : 0;
    const float scale = weight / std::sqrt(std::max(square, 1e-12F));
    sums.x[i] += x * scale;
    sums.y[i] += y * scale;
    sums.z[i] += z * scale;
    sums.count[i] += weight;
  }
}

void add_pixels(const DirectionCamera& view, Pixel corner, const Eigen::Vector3f& p,
                float range2_m2, Sum& sum) {
  const int u_end = std::min(corner.u + ReadingTiles::kTilePx, view.obstacle_depth_m.width);
  const int v_end = std::min(corner.v + ReadingTiles::kTilePx, view.obstacle_depth_m.height);
  for (int v = corner.v; v < v_end; ++v) {
    for (int u = corner.u; u < u_end; ++u) {
      const float depth_m = view.obstacle_depth_m(u, v);
      if (std::isnan(depth_m)) continue;
      const Eigen::Vector3f way = point_C_m(view.camera, u, v, depth_m) - p;
      const float square = way.squaredNorm();
      if (square > range2_m2 || square == 0) continue;
      sum.direction += (way / std::sqrt(square)).cast<double>();
      sum.count += 1;
    }
  }
}

/// In frame C.
Sum sum_of_view(const DirectionCamera& view, const Eigen::Vector3f& p, float range2_m2) {
  LaneSums lanes;
  Sum sum;
  std::array<bool, kTilesAtOnce> is_near{};
  for (std::size_t first = 0; first < view.tiles.count.size(); first += kTilesAtOnce) {
    add_far_tiles(view.tiles, first, p, range2_m2, lanes, is_near);
    for (int i = 0; i < kTilesAtOnce; ++i) {
      if (is_near[i] && view.tiles.count[first + i] > 0) {
        add_pixels(view, view.tiles.corner[first + i], p, range2_m2, sum);
      }
    }
  }
  for (int i = 0; i < kTilesAtOnce; ++i) {
    sum.direction += Eigen::Vector3d(lanes.x[i], lanes.y[i], lanes.z[i]);
    sum.count += lanes.count[i];
  }
  return sum;
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
      const TileSum sum = sum_of(obstacle_depth_m, rect);
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
  Sum all;
  const auto range2_m2 = static_cast<float>(range_m * range_m);
  for (const DirectionCamera& view : views) {
    const Eigen::Vector3f p_C_m = (view.X_BC.inverse() * p_B_m).cast<float>();
    const Sum sum = sum_of_view(view, p_C_m, range2_m2);
    all.direction += view.X_BC.linear() * sum.direction;
    all.count += sum.count;
  }
  MeanDirection mean;
  mean.count = static_cast<std::int64_t>(all.count);
  mean.direction_B = (all.direction / all.count).cast<float>();
  return mean;
}

}  // namespace berth
