#pragma once

#include <algorithm>
#include <cmath>

#include "berth/types/image.hpp"

namespace berth {

/// The greatest step between neighbouring readings of one surface, at up to 1 m. From 2 to 4 cm the
/// recordings are judged alike (docs/self-filter-defaults.md).
inline constexpr float kJoinedStep_m = 0.03F;

/// What it is for a surface at depth z: a sensor's steps and noise grow with z^2.
inline float joined_step_m(float z_m) { return kJoinedStep_m * std::max(1.0F, z_m * z_m); }

/// Whether neighbouring readings are parts of one surface: they differ by at most the step at the
/// nearer one's depth. False where one is NaN.
inline bool is_joined(float a_m, float b_m) {
  return std::abs(a_m - b_m) <= joined_step_m(std::min(a_m, b_m));
}

/// Whether call(q) holds for a pixel q that is joined to p, one of its neighbours (8) or p itself;
/// asks no more of them then. Looks only at those of which is_wanted(q) holds.
template <class IsWanted, class Call>
bool any_joined(DepthView depth_m, Pixel p, const IsWanted& is_wanted, const Call& call) {
  const float own_m = depth_m(p.u, p.v);
  for (int v = std::max(0, p.v - 1); v <= std::min(depth_m.height - 1, p.v + 1); ++v) {
    for (int u = std::max(0, p.u - 1); u <= std::min(depth_m.width - 1, p.u + 1); ++u) {
      const Pixel q{u, v};
      if (is_wanted(q) && is_joined(depth_m(u, v), own_m) && call(q)) return true;
    }
  }
  return false;
}

}  // namespace berth
