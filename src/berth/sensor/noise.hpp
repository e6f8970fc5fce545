// Inside sensor/ only.
#pragma once

#include <algorithm>

namespace berth {

/// What `at_1m_m` is at depth z: a depth camera's steps and noise grow with z^2, and not below 1 m.
inline float grown_with_depth(float at_1m_m, float z_m) {
  return at_1m_m * std::max(1.0F, z_m * z_m);
}

}  // namespace berth
