#pragma once

#include <Eigen/Core>

#include "berth/distance/metric.hpp"

namespace berth {

/// `intrinsics` of metric.glsl.
inline Eigen::Vector4f gl_intrinsics(const Metric& metric) {
  return {metric.cx_px, metric.cy_px, metric.inv_fx, metric.inv_fy};
}

}  // namespace berth
