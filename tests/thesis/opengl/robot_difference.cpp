#include "tests/thesis/opengl/robot_difference.hpp"

#include <algorithm>
#include <cmath>

namespace berth {
namespace {

/// A plane's inverse depth is linear over the image: what bends by more than this share of itself
/// within two pixels is a crease or a step.
constexpr double kBend = 1e-4;

bool bends(const RobotImage& image, const Pixel& p, int du, int dv) {
  const int width = image.link_id.width();
  const int height = image.link_id.height();
  const Pixel before{p.u - du, p.v - dv};
  const Pixel after{p.u + du, p.v + dv};
  if (before.u < 0 || before.v < 0 || after.u >= width || after.v >= height || after.v < 0)
    return false;
  const LinkId id = image.link_id(p.u, p.v);
  if (image.link_id(before.u, before.v) != id || image.link_id(after.u, after.v) != id) return true;
  const double here = 1.0 / image.depth_m(p.u, p.v);
  const double mean =
      (1.0 / image.depth_m(before.u, before.v) + 1.0 / image.depth_m(after.u, after.v)) / 2;
  return std::abs(mean - here) > kBend * here;
}

bool is_edge(const RobotImage& image, const Pixel& p) {
  for (int v = std::max(0, p.v - 1); v <= std::min(image.link_id.height() - 1, p.v + 1); ++v) {
    for (int u = std::max(0, p.u - 1); u <= std::min(image.link_id.width() - 1, p.u + 1); ++u) {
      for (const auto& [du, dv] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
        if (bends(image, {u, v}, du, dv)) return true;
      }
    }
  }
  return false;
}

}  // namespace

RobotDifference difference(const RobotImage& gpu, const RobotImage& cpu) {
  RobotDifference result;
  for (int v = 0; v < cpu.link_id.height(); ++v) {
    for (int u = 0; u < cpu.link_id.width(); ++u) {
      const LinkId id = cpu.link_id(u, v);
      result.robot_pixels += id != kNoLink;
      const bool same_id = id == gpu.link_id(u, v);
      const bool none = id == kNoLink && std::isnan(gpu.depth_m(u, v));
      const double error =
          none ? 0 : std::abs(gpu.depth_m(u, v) - cpu.depth_m(u, v)) / cpu.depth_m(u, v);
      if (same_id && error <= kDepthError) {
        result.depth_error = std::max(result.depth_error, error);
      } else if (is_edge(cpu, {u, v}) || is_edge(gpu, {u, v})) {
        ++result.at_edges;
      } else {
        result.wrong.push_back({u, v});
      }
    }
  }
  return result;
}

}  // namespace berth
