#include "tests/render/comparison.hpp"

#include <cmath>

namespace berth {
namespace {

constexpr double kDepthTolerance = 1e-4;
constexpr double kTieTolerance = 1e-6;
constexpr double kEdge_px = 0.01;

bool same_depth(const sim::RayHit& a, const sim::RayHit& b, double tolerance) {
  return std::abs(a.depth_m - b.depth_m) <= tolerance * a.depth_m;
}

bool same(const sim::RayHit& a, const sim::RayHit& b, double tolerance) {
  return a.id == b.id && (a.id == kNoLink || same_depth(a, b, tolerance));
}

bool is_tie(const sim::RayHit& a, const sim::RayHit& b) {
  return a.id != kNoLink && b.id != kNoLink && same_depth(a, b, kTieTolerance);
}

bool is_edge(const CastRay& twin, const sim::RayHit& centre, int u, int v) {
  for (const auto& [du, dv] : {std::pair{kEdge_px, kEdge_px},
                               {kEdge_px, -kEdge_px},
                               {-kEdge_px, kEdge_px},
                               {-kEdge_px, -kEdge_px}}) {
    if (!same(centre, twin(u + du, v + dv), kDepthTolerance / 2)) return true;
  }
  return false;
}

}  // namespace

Comparison compare(const RobotImage& image, const CastRay& twin) {
  Comparison result;
  for (int v = 0; v < image.depth_m.height(); ++v) {
    for (int u = 0; u < image.depth_m.width(); ++u) {
      const sim::RayHit expected = twin(u, v);
      const sim::RayHit found{image.link_id(u, v), image.depth_m(u, v)};
      ++result.pixels;
      if (expected.id != kNoLink) ++result.robot_pixels;
      if (std::isnan(found.depth_m) != (found.id == kNoLink)) {
        result.wrong.push_back({u, v});
      } else if (same(expected, found, kDepthTolerance)) {
        continue;
      } else if (is_tie(expected, found)) {
        ++result.ties;
      } else if (is_edge(twin, expected, u, v)) {
        ++result.at_edges;
      } else {
        result.wrong.push_back({u, v});
      }
    }
  }
  return result;
}

}  // namespace berth
