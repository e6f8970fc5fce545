#include "berth/render/triangle_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berth {
namespace {

using ExactCorners = std::array<Eigen::Vector3d, 3>;

/// True where all of the triangle lies on one side of one border of the rectangle, or behind.
bool is_outside(const ExactCorners& corners, const PixelRect& rect) {
  const auto all = [&](const Eigen::Vector3d& side) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Eigen::Vector3d& p) { return side.dot(p) < 0; });
  };
  const auto border = [](int pixel, int outward) { return pixel + outward * 0.1; };
  return all({0, 0, 1}) || all({1, 0, -border(rect.u_begin, -1)}) ||
         all({-1, 0, border(rect.u_end - 1, 1)}) || all({0, 1, -border(rect.v_begin, -1)}) ||
         all({0, -1, border(rect.v_end - 1, 1)});
}

/// The part of `rect` that holds the triangle; all of it where a corner has no image.
PixelRect bounds_in(const ExactCorners& corners, const PixelRect& rect) {
  constexpr double kLeastDepth_m = 1e-6;
  Eigen::AlignedBox2d bounds_px;
  for (const Eigen::Vector3d& p : corners) {
    if (p.z() < kLeastDepth_m) return rect;
    bounds_px.extend(p.head<2>() / p.z());
  }
  const auto first = [](double at, int begin, int end) {
    return static_cast<int>(std::clamp<double>(std::ceil(at - kEdgeTolerance_px), begin, end));
  };
  return {first(bounds_px.min().x(), rect.u_begin, rect.u_end),
          first(bounds_px.min().y(), rect.v_begin, rect.v_end),
          first(std::floor(bounds_px.max().x() + kEdgeTolerance_px) + 1, rect.u_begin, rect.u_end),
          first(std::floor(bounds_px.max().y() + kEdgeTolerance_px) + 1, rect.v_begin, rect.v_end)};
}

void put_edge(const Eigen::Vector3d& edge, const Eigen::Vector3d& first,
              float (&out)[3][TrianglePlanes::kTriangles], int lane) {
  const double scale = 1 / std::max(edge.head<2>().lpNorm<1>(), 1e-300);
  out[0][lane] = static_cast<float>(edge.dot(first) * scale + kEdgeTolerance_px);
  out[1][lane] = static_cast<float>(edge.x() * scale);
  out[2][lane] = static_cast<float>(edge.y() * scale);
}

}  // namespace

bool plan_exactly(const ExactCorners& corners, const PixelRect& rect, int lane,
                  TrianglePlanes& out) {
  if (is_outside(corners, rect)) return false;
  const PixelRect bounds = bounds_in(corners, rect);
  const double determinant = corners[0].dot(corners[1].cross(corners[2]));
  if (bounds.empty() || determinant == 0) return false;
  // A pixel's ray is (u, v, 1) = sum of edge_i corner_i: it meets the triangle where no edge_i is
  // negative, and since corners carry z in their last place, the sum of the edge_i is 1 / z there.
  const Eigen::Vector3d first(bounds.u_begin, bounds.v_begin, 1);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d edge = corners[(i + 1) % 3].cross(corners[(i + 2) % 3]) / determinant;
    put_edge(edge, first, out.edge[i], lane);
    sum += edge;
  }
  out.inverse_depth[0][lane] = static_cast<float>(sum.dot(first));
  out.inverse_depth[1][lane] = static_cast<float>(sum.x());
  out.inverse_depth[2][lane] = static_cast<float>(sum.y());
  // Edge on, it has no depth, and no pixel.
  if (!std::isfinite(out.inverse_depth[0][lane]) || !std::isfinite(out.inverse_depth[1][lane]) ||
      !std::isfinite(out.inverse_depth[2][lane]))
    return false;
  const auto [nearest_m, farthest_m] =
      std::minmax({corners[0].z(), corners[1].z(), corners[2].z()});
  constexpr double kGreatest = std::numeric_limits<float>::max();
  out.inverse_depth_lo[lane] = static_cast<float>(1 / farthest_m);
  out.inverse_depth_hi[lane] =
      static_cast<float>(nearest_m > 0 ? std::min(1 / nearest_m, kGreatest) : kGreatest);
  out.u[lane] = static_cast<float>(bounds.u_begin);
  out.v[lane] = static_cast<float>(bounds.v_begin);
  out.last_du[lane] = static_cast<float>(bounds.u_end - 1 - bounds.u_begin);
  out.last_dv[lane] = static_cast<float>(bounds.v_end - 1 - bounds.v_begin);
  return true;
}

}  // namespace berth
