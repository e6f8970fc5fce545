#include "sim/other_metric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berth::sim {
namespace {

constexpr int kTilePx = 8;

/// Pixels of one tile that belong together, and a box around all that they may stand for.
struct Tile {
  std::vector<Pixel> pixels;
  Eigen::AlignedBox3d box_C;
};

Eigen::Vector3d back_project(const Camera& camera, double u_corner_px, double v_corner_px) {
  return {(u_corner_px - camera.corner_cx_px()) / camera.fx_px,
          (v_corner_px - camera.corner_cy_px()) / camera.fy_px, 1};
}

/// The sides at which two pixels face each other along one axis: robot's and obstacle's, as corners
/// (Hirt 2.10 to 2.13). Pixels in the same column or row are both taken at their lower side.
std::pair<int, int> facing_sides(int robot_px, int obstacle_px) {
  if (robot_px < obstacle_px) return {robot_px + 1, obstacle_px};
  if (robot_px > obstacle_px) return {robot_px, obstacle_px + 1};
  return {robot_px, obstacle_px};
}

/// All of the pixel from depth near_m to far_m.
void extend(Tile& tile, const Camera& camera, Pixel pixel, double near_m, double far_m) {
  tile.pixels.push_back(pixel);
  for (const int side : {0, 1}) {
    for (const double depth_m : {near_m, far_m}) {
      // x and y do not depend on each other: two corners make the box.
      tile.box_C.extend(depth_m * back_project(camera, pixel.u + side, pixel.v + side));
    }
  }
}

/// Tiles of the pixels for which depths(u, v) is a pair of near and far depth.
template <class Depths>
std::vector<Tile> make_tiles(const Camera& camera, Depths depths) {
  std::vector<Tile> tiles;
  for (int v0 = 0; v0 < camera.height_px; v0 += kTilePx) {
    for (int u0 = 0; u0 < camera.width_px; u0 += kTilePx) {
      Tile tile;
      for (int v = v0; v < std::min(v0 + kTilePx, camera.height_px); ++v) {
        for (int u = u0; u < std::min(u0 + kTilePx, camera.width_px); ++u) {
          if (const auto range = depths(u, v)) {
            extend(tile, camera, {u, v}, range->first, range->second);
          }
        }
      }
      if (!tile.pixels.empty()) tiles.push_back(std::move(tile));
    }
  }
  return tiles;
}

using DepthRange = std::optional<std::pair<double, double>>;

struct TilePair {
  double bound_m;
  const Tile* robot;
  const Tile* obstacle;
};

/// Nearest bound first. Left out are those whose bound is no less than less_than_m, or than the
/// greatest distance within any two tiles, since both points of a pair lie in their boxes.
std::vector<TilePair> sorted_pairs(const std::vector<Tile>& robot,
                                   const std::vector<Tile>& obstacles, double less_than_m) {
  for (const Tile& r : robot) {
    for (const Tile& o : obstacles) {
      const double most_m = r.box_C.merged(o.box_C).diagonal().norm();
      less_than_m = std::min(less_than_m, most_m * (1 + 1e-9));
    }
  }
  std::vector<TilePair> pairs;
  for (const Tile& r : robot) {
    for (const Tile& o : obstacles) {
      const double bound_m = r.box_C.exteriorDistance(o.box_C);
      if (bound_m < less_than_m) pairs.push_back({bound_m, &r, &o});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const TilePair& a, const TilePair& b) { return a.bound_m < b.bound_m; });
  return pairs;
}

/// Of all pixels of the two tiles.
double least_distance_m(OtherMetric metric, const Camera& camera, const RobotImage& robot,
                        const DepthImage& obstacle_depth_m, const TilePair& pair) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Pixel r : pair.robot->pixels) {
    for (const Pixel o : pair.obstacle->pixels) {
      least_m = std::min(least_m, other_distance_m(metric, camera, r, robot.depth_m(r.u, r.v), o,
                                                   obstacle_depth_m(o.u, o.v)));
    }
  }
  return least_m;
}

std::optional<double> least_distance_m(OtherMetric metric, const Camera& camera,
                                       const RobotImage& robot, const DepthImage& obstacle_depth_m,
                                       LinkId id, double range_m) {
  double farthest_m = 0;
  const auto robot_tiles = make_tiles(camera, [&](int u, int v) -> DepthRange {
    if (robot.link_id(u, v) != id) return std::nullopt;
    const double depth_m = robot.depth_m(u, v);
    farthest_m = std::max(farthest_m, depth_m);
    return std::pair(depth_m, depth_m);
  });
  if (robot_tiles.empty()) return std::nullopt;
  const auto obstacle_tiles = make_tiles(camera, [&](int u, int v) -> DepthRange {
    const double depth_m = obstacle_depth_m(u, v);
    if (std::isnan(depth_m)) return std::nullopt;
    const bool is_ray = metric == OtherMetric::hidden_ray;
    return std::pair(depth_m, is_ray ? std::max(depth_m, farthest_m) : depth_m);
  });
  double best_m = std::numeric_limits<double>::infinity();
  const double above_range_m = std::nextafter(range_m, best_m);
  for (const TilePair& pair : sorted_pairs(robot_tiles, obstacle_tiles, above_range_m)) {
    if (pair.bound_m >= best_m) break;
    best_m = std::min(best_m, least_distance_m(metric, camera, robot, obstacle_depth_m, pair));
  }
  return best_m <= range_m ? std::optional(best_m) : std::nullopt;
}

}  // namespace

double other_distance_m(OtherMetric metric, const Camera& camera, Pixel robot, double robot_depth_m,
                        Pixel obstacle, double obstacle_depth_m) {
  const auto [robot_u, obstacle_u] = facing_sides(robot.u, obstacle.u);
  const auto [robot_v, obstacle_v] = facing_sides(robot.v, obstacle.v);
  const Eigen::Vector3d p_C = robot_depth_m * back_project(camera, robot_u, robot_v);
  const Eigen::Vector3d ray = back_project(camera, obstacle_u, obstacle_v);
  double depth_m = obstacle_depth_m;
  if (metric == OtherMetric::hidden_ray) {
    depth_m = std::clamp(p_C.dot(ray) / ray.squaredNorm(), obstacle_depth_m,
                         std::max(obstacle_depth_m, robot_depth_m));
  }
  return (depth_m * ray - p_C).norm();
}

std::vector<std::optional<double>> other_distances_m(OtherMetric metric, const Camera& camera,
                                                     const RobotImage& robot,
                                                     const DepthImage& obstacle_depth_m,
                                                     int link_count, double range_m) {
  std::vector<std::optional<double>> distances_m(link_count);
  for (int link = 0; link < link_count; ++link) {
    distances_m[link] = least_distance_m(metric, camera, robot, obstacle_depth_m,
                                         static_cast<LinkId>(link + 1), range_m);
  }
  return distances_m;
}

}  // namespace berth::sim
