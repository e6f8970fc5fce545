#pragma once

#include <Eigen/Core>

#include "thesis/closest_pair.hpp"
#include "thesis/metric.hpp"

namespace berth {

/// `intrinsics` of metric.glsl.
inline Eigen::Vector4f gl_intrinsics(const Metric& metric) {
  return {metric.cx_px, metric.cy_px, metric.inv_fx, metric.inv_fy};
}

/// What D^2 has to be below on the GPU. A little too far: whether a distance is within the range is
/// decided at the end, on the CPU.
inline float gl_farthest_m2(double range_m) {
  return no_pair_within(static_cast<float>(range_m)).squared_m2 * (1 + 1e-5f);
}

}  // namespace berth
