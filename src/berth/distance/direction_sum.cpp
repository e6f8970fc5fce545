#include "berth/distance/direction_sum.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/direction_sum.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// A row is short enough for sums in float.
void add_row(const Metric& metric, const DirectionStart& start, float ov, const float* row_m,
             const PixelRect& rect, DirectionSum& sum) {
  const FloatTag d;
  const BasicMetric<Lanes> metrics = broadcast(metric);
  Lanes x(0);
  Lanes y(0);
  Lanes z(0);
  Lanes count(0);
  for (int u = rect.u_begin; u < rect.u_end; u += kLanes) {
    const Lanes depth_m = load_first(row_m + u, rect.u_end - u);
    const auto vector = pair_vector(metrics, Lanes(start.u), Lanes(start.v), Lanes(start.depth_m),
                                    count_up(static_cast<float>(u)), Lanes(ov), depth_m);
    const Lanes squared_m2 = squared_length_m2(vector);
    const auto counts = hn::And(hn::Le(depth_m.v, hn::Set(d, start.max_depth_m)),
                                hn::Gt(squared_m2.v, hn::Zero(d)));
    const auto inverse_length = hn::Div(hn::Set(d, 1.0f), hn::Sqrt(squared_m2.v));
    x = x + hn::IfThenElseZero(counts, hn::Mul(vector.x_m.v, inverse_length));
    y = y + hn::IfThenElseZero(counts, hn::Mul(vector.y_m.v, inverse_length));
    z = z + hn::IfThenElseZero(counts, hn::Mul(vector.z_m.v, inverse_length));
    count = count + hn::IfThenElseZero(counts, hn::Set(d, 1.0f));
  }
  sum.x += sum_of_lanes(x);
  sum.y += sum_of_lanes(y);
  sum.z += sum_of_lanes(z);
  sum.count += sum_of_lanes(count);
}

DirectionSum add_rows(const Metric& metric, const DirectionStart& start,
                      const DepthView& obstacle_depth_m, const PixelRect& rect) {
  DirectionSum sum;
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    add_row(metric, start, static_cast<float>(v), obstacle_depth_m.row(v), rect, sum);
  }
  return sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(add_rows);

DirectionSum sum_directions(const Metric& metric, const DirectionStart& start,
                            DepthView obstacle_depth_m, PixelRect rect) {
  return HWY_DYNAMIC_DISPATCH(add_rows)(metric, start, obstacle_depth_m, rect);
}

}  // namespace berth
#endif  // HWY_ONCE
