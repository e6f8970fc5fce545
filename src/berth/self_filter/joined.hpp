// Inside self_filter/ only.
#pragma once

#include <algorithm>
#include <cmath>

namespace berth {

/// Whether neighbouring readings are parts of one surface: they differ by at most
/// jump_m max(1, z^2), z being the nearer one in metres, as a sensor's steps and noise grow. False
/// where one is NaN.
inline bool is_joined(float a_m, float b_m, float jump_m) {
  const float z_m = std::min(a_m, b_m);
  return std::abs(a_m - b_m) <= jump_m * std::max(1.0F, z_m * z_m);
}

}  // namespace berth
