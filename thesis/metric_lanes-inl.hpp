// The metric over vectors of floats, for the instruction set that the including file is being
// compiled for.
#if defined(BERTH_DISTANCE_METRIC_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_METRIC_LANES_INL_HPP
#undef BERTH_DISTANCE_METRIC_LANES_INL_HPP
#else
#define BERTH_DISTANCE_METRIC_LANES_INL_HPP
#endif

#include "berth/vector/lanes-inl.hpp"
#include "thesis/metric.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

using Number = Lanes;
#include "thesis/metric_formula-inl.hpp"

HWY_INLINE BasicMetric<Lanes> broadcast(const Metric& m) {
  return {Lanes(m.cx_px), Lanes(m.cy_px), Lanes(m.inv_fx), Lanes(m.inv_fy)};
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
