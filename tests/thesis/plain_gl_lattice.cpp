#include "tests/thesis/plain_gl_lattice.hpp"

#include <algorithm>
#include <tuple>

#include "thesis/closest_pair.hpp"
#include "thesis/opengl/gl_metric.hpp"

namespace berth::testing {
namespace {

struct ImageRequest {
  const sim::ImagePair& images;
  const LatticeSettings& lattice;
  float range_m;
  LinkId id;
};

bool is_of_link(const ImageRequest& request, Pixel p) {
  const Image<LinkId>& ids = request.images.robot.link_id;
  return p.u >= 0 && p.v >= 0 && p.u < ids.width() && p.v < ids.height() &&
         ids(p.u, p.v) == request.id;
}

/// Manhattan distance from the tile's centre in half pixels.
int half_pixels_from_centre(int u, int v, int tile_px) {
  return std::abs(2 * u + 1 - tile_px) + std::abs(2 * v + 1 - tile_px);
}

/// Of each tile of the window the pixel nearest to the tile's centre, by rows of pixels.
std::vector<Pixel> tile_points(const ImageRequest& request, const PixelRect& window, int tile_px) {
  std::vector<Pixel> points;
  for (int v = window.v_begin; v < window.v_end; v += tile_px) {
    for (int u = window.u_begin; u < window.u_end; u += tile_px) {
      Pixel nearest;
      int least = 1 << 30;
      for (int dv = 0; dv < std::min(tile_px, window.v_end - v); ++dv) {
        for (int du = 0; du < std::min(tile_px, window.u_end - u); ++du) {
          const int away = half_pixels_from_centre(du, dv, tile_px);
          if (away >= least || !is_of_link(request, {u + du, v + dv})) continue;
          least = away;
          nearest = {u + du, v + dv};
        }
      }
      if (nearest.u >= 0) points.push_back(nearest);
    }
  }
  std::sort(points.begin(), points.end(),
            [](Pixel a, Pixel b) { return std::tie(a.v, a.u) < std::tie(b.v, b.u); });
  return points;
}

std::vector<Pixel> disc_points(const ImageRequest& request, Pixel centre, int radius_px) {
  std::vector<Pixel> points;
  for (int v = centre.v - radius_px; v <= centre.v + radius_px; ++v) {
    for (int u = centre.u - radius_px; u <= centre.u + radius_px; ++u) {
      const int du = u - centre.u;
      const int dv = v - centre.v;
      const bool is_within = du * du + dv * dv <= radius_px * radius_px;
      if (is_within && is_of_link(request, {u, v})) points.push_back({u, v});
    }
  }
  return points;
}

/// Returns the number of pairs.
std::int64_t try_points(const sim::ImagePair& images, const std::vector<Pixel>& points, int step_x,
                        int step_y, ClosestPair& best) {
  const Metric metric = metric_of(images.camera);
  const DepthImage& depth_m = images.obstacle_depth_m;
  std::int64_t pairs = 0;
  for (const Pixel p : points) {
    const auto ru = static_cast<float>(p.u);
    const auto rv = static_cast<float>(p.v);
    const float robot_m = images.robot.depth_m(p.u, p.v);
    for (int v = p.v % step_y; v < depth_m.height(); v += step_y) {
      for (int u = p.u % step_x; u < depth_m.width(); u += step_x) {
        if (std::isnan(depth_m(u, v))) continue;
        ++pairs;
        const auto ou = static_cast<float>(u);
        const auto ov = static_cast<float>(v);
        const float m2 = squared_distance_m2(metric, ru, rv, robot_m, ou, ov, depth_m(u, v));
        if (m2 < best.squared_m2) best = {m2, ru, rv, robot_m, ou, ov, depth_m(u, v)};
      }
    }
  }
  return pairs;
}

LinkDistance search_link(const ImageRequest& request, std::int64_t& pairs) {
  const sim::ImagePair& images = request.images;
  const auto& [step_x, step_y, initial_px, final_px, first_tile_px] = request.lattice;
  const Image<LinkId>& ids = images.robot.link_id;
  const auto pixels = std::count(ids.pixels().begin(), ids.pixels().end(), request.id);
  ClosestPair best{gl_farthest_m2(request.range_m)};
  const auto closest = [&] { return Pixel{static_cast<int>(best.ru), static_cast<int>(best.rv)}; };
  int tile_px = first_tile_px;
  pairs += try_points(images, tile_points(request, {0, 0, ids.width(), ids.height()}, tile_px),
                      step_x, step_y, best);
  while (best.ru >= 0 && tile_px > final_px) {
    const auto [u, v] = closest();
    const PixelRect window{u - tile_px, v - tile_px, u + tile_px, v + tile_px};
    tile_px = std::max(tile_px / 2, final_px);
    pairs += try_points(images, tile_points(request, window, tile_px), step_x, step_y, best);
  }
  if (best.ru >= 0) {
    pairs += try_points(images, disc_points(request, closest(), final_px), 1, 1, best);
  }
  return link_distance(request.id, static_cast<int>(pixels), metric_of(images.camera), best,
                       request.range_m);
}

}  // namespace

LinkDistances plain_gl_lattice(const sim::ImagePair& images,
                               const ImageDistanceSettings& settings) {
  LinkDistances found;
  const auto range_m = static_cast<float>(settings.range_m);
  for (int i = 1; i <= images.link_count; ++i) {
    found.links.push_back(
        search_link({images, settings.lattice, range_m, static_cast<LinkId>(i)}, found.pairs));
  }
  return found;
}

}  // namespace berth::testing
