#include "thesis/exact/surface_axes.hpp"

#include <cmath>

namespace berth {

Axes axes_of(const Metric& metric, const Normal& towards) {
  const Eigen::Vector3f direction(towards.x, towards.y, towards.z);
  const float length = direction.norm();
  const Eigen::Vector3f normal = std::isfinite(length) && length > 0
                                     ? Eigen::Vector3f(direction / length)
                                     : Eigen::Vector3f::UnitZ();
  // Along the image's rows, so that tiles are narrow along the second axis as well.
  const Eigen::Vector3f row =
      std::abs(normal.x()) < 0.9f ? Eigen::Vector3f::UnitX() : Eigen::Vector3f::UnitY();
  const Eigen::Vector3f second = (row - row.dot(normal) * normal).normalized();
  const Eigen::Vector3f third = normal.cross(second);
  Axes axes;
  const Eigen::Vector3f* const directions[3] = {&normal, &second, &third};
  for (int k = 0; k < 3; ++k) {
    axes.x[k] = directions[k]->x();
    axes.y[k] = directions[k]->y();
    axes.z[k] = directions[k]->z();
    axes.per_u[k] = axes.x[k] * metric.inv_fx;
    axes.per_v[k] = axes.y[k] * metric.inv_fy;
    axes.half[k] = 0.5f * (std::abs(axes.per_u[k]) + std::abs(axes.per_v[k]));
  }
  return axes;
}

InversePlane solve_plane(const float (&sum)[9]) {
  const float n = sum[0];
  if (n < 3) return {};
  const float u = sum[1] / n;
  const float v = sum[2] / n;
  const float uu = sum[3] / n - u * u;
  const float uv = sum[4] / n - u * v;
  const float vv = sum[5] / n - v * v;
  const float w = sum[6] / n;
  const float uw = sum[7] / n - u * w;
  const float vw = sum[8] / n - v * w;
  const float determinant = uu * vv - uv * uv;
  if (!(determinant > 1e-3f)) return {};
  const float a = (uw * vv - vw * uv) / determinant;
  const float b = (vw * uu - uw * uv) / determinant;
  return {a, b, w - a * u - b * v};
}

Axes axes_along(const Metric& metric, const InversePlane& plane, float u, float v) {
  // The tile counts pixel centres, the metric corners.
  const float c =
      plane.c + plane.a * (metric.cx_px - 0.5f - u) + plane.b * (metric.cy_px - 0.5f - v);
  return axes_of(metric, {plane.a / metric.inv_fx, plane.b / metric.inv_fy, c});
}

}  // namespace berth
