// Axes along a surface, for bounds that are tight where it is tilted.
#pragma once

#include <cmath>

#include "thesis/metric.hpp"

namespace berth {

/// Three directions in frame C, orthonormal up to rounding: a surface's normal first.
struct Axes {
  float x[3];
  float y[3];
  float z[3];
  /// How a point at depth 1 moves along each axis from one pixel to the next; and half of what its
  /// pixel's square fills.
  float per_u[3];
  float per_v[3];
  float half[3];
};

/// Sides along three axes.
struct AlignedBox {
  float lo_m[3];
  float hi_m[3];
};

/// Where a tile's pixels lie along one axis, as multiples of their depth: pixel (c, r) of the tile
/// spans first + c per_u + r per_v +- half.
struct AxisRate {
  float first;
  float per_u;
  float per_v;
  float half;
};

/// How much the squared length along axes may exceed the true one, because they are orthonormal but
/// for a few roundings of 2^-24.
inline constexpr float kOrthonormal = 1 - 0x1p-18f;

/// The centre of a tile's corner pixel, from the principal point.
struct TileCorner {
  float x_px;
  float y_px;
  /// 32 roundings of the largest coordinate, at depth 1, in the tile: 12 that are made from here to
  /// the product with the depth, and those of the metric; so that a bound from rates that are
  /// widened by it is never above the metric's own, rounded, result.
  float rounding;
};

inline TileCorner tile_corner(const Metric& metric, float u, float v) {
  const float x_px = u + 0.5f - metric.cx_px;
  const float y_px = v + 0.5f - metric.cy_px;
  const float reach =
      (std::abs(x_px) + 8) * metric.inv_fx + (std::abs(y_px) + 8) * metric.inv_fy + 1;
  return {x_px, y_px, 0x1p-19f * reach};
}

inline AxisRate rate_along(const Axes& axes, int k, const TileCorner& corner) {
  return {corner.x_px * axes.per_u[k] + corner.y_px * axes.per_v[k] + axes.z[k], axes.per_u[k],
          axes.per_v[k], axes.half[k] + corner.rounding};
}

/// 1 / depth = a u + b v + c in a tile's own columns and rows, counted from its corner: the form of
/// every plane. Zero where three pixels that are not in line are missing.
struct InversePlane {
  float a = 0;
  float b = 0;
  float c = 0;
};

/// From the sums of 1, u, v, u^2, u v, v^2, w, u w, v w with w = 1 / depth.
InversePlane solve_plane(const float (&sum)[9]);

/// Axes with the normal of the plane that a tile with the corner (u, v) shows; the camera's own
/// where the plane has no normal.
Axes axes_along(const Metric& metric, const InversePlane& plane, float u, float v);

/// A direction; its length does not matter.
struct Normal {
  float x = 0;
  float y = 0;
  float z = 0;
};

/// Axes with this normal; the camera's own where it has no direction.
Axes axes_of(const Metric& metric, const Normal& normal);

}  // namespace berth
