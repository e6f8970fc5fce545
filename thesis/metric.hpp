// The distance of a robot pixel and an obstacle pixel (Hirt 2.10 to 2.14).
#pragma once

#include <Eigen/Core>

#include "berth/types/camera.hpp"

namespace berth {

/// A camera's intrinsics as the metric needs them; the principal point in the **corner**
/// convention. T is the number type of metric_formula-inl.hpp, here and below.
template <class T>
struct BasicMetric {
  T cx_px;
  T cy_px;
  T inv_fx;
  T inv_fy;
};
using Metric = BasicMetric<float>;

/// From the robot point to the obstacle point of a pair, in frame C.
template <class T>
struct BasicPairVector {
  T x_m;
  T y_m;
  T z_m;
};

/// The sides at which two pixels face each other along one axis, corner convention.
template <class T>
struct FacingSides {
  T robot_px;
  T obstacle_px;
};

inline Metric metric_of(const Camera& camera) {
  return {static_cast<float>(camera.corner_cx_px()), static_cast<float>(camera.corner_cy_px()),
          static_cast<float>(1 / camera.fx_px), static_cast<float>(1 / camera.fy_px)};
}

/// The number that metric_formula-inl.hpp is about.
using Number = float;
inline float least(float a, float b) { return a < b ? a : b; }
inline float greatest(float a, float b) { return a > b ? a : b; }
/// max(0, x), and NaN for NaN.
inline float positive_part(float x) { return x < 0 ? 0 : x; }

#include "thesis/metric_formula-inl.hpp"

/// Both points of a pair, in frame C.
struct PairPoints {
  Eigen::Vector3f robot_C_m;
  Eigen::Vector3f obstacle_C_m;
};

/// The two points whose distance is D; arguments as for pair_vector.
inline PairPoints pair_points(const Metric& metric, float ru, float rv, float robot_depth_m,
                              float ou, float ov, float obstacle_depth_m) {
  const Eigen::Vector3f robot_C_m(
      (facing_sides(ru, ou).robot_px - metric.cx_px) * robot_depth_m * metric.inv_fx,
      (facing_sides(rv, ov).robot_px - metric.cy_px) * robot_depth_m * metric.inv_fy,
      robot_depth_m);
  const auto v = pair_vector(metric, ru, rv, robot_depth_m, ou, ov, obstacle_depth_m);
  return {robot_C_m, robot_C_m + Eigen::Vector3f(v.x_m, v.y_m, v.z_m)};
}

}  // namespace berth
