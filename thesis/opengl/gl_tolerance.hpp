#pragma once

#include <Eigen/Core>

#include "berth/self_filter/settings.hpp"

namespace berth {

/// `tolerance` of tolerance.glsl.
inline Eigen::Vector4f gl_tolerance(const Tolerance& tolerance) {
  return {tolerance.constant_m, 0, tolerance.per_m2, 0};
}

}  // namespace berth
