// A rendered image beside a twin that casts rays.
#pragma once

#include <functional>
#include <vector>

#include "sim/ray_hit.hpp"

namespace berth {

/// What the ray through (u, v), in pixels, meets first.
using CastRay = std::function<sim::RayHit(double u, double v)>;

/// How an image differs from the twin's.
struct Comparison {
  int pixels = 0;
  int robot_pixels = 0;
  /// Two links' surfaces in one place, so that either id is right: depths within 1e-6 of
  /// themselves.
  int ties = 0;
  /// Other differences within 0.01 px of an outline, a crease or a steep slope, where rounding
  /// decides.
  int at_edges = 0;
  /// All others: id, depth by more than 1e-4 of itself, or a depth where no link is.
  std::vector<Pixel> wrong;
};

Comparison compare(const RobotImage& image, const CastRay& twin);

}  // namespace berth
