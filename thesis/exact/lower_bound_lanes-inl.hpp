// The lower bound over vectors of floats, for the instruction set that the including file is being
// compiled for.
#if defined(BERTH_DISTANCE_EXACT_LOWER_BOUND_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_EXACT_LOWER_BOUND_LANES_INL_HPP
#undef BERTH_DISTANCE_EXACT_LOWER_BOUND_LANES_INL_HPP
#else
#define BERTH_DISTANCE_EXACT_LOWER_BOUND_LANES_INL_HPP
#endif

#include "thesis/exact/lower_bound.hpp"
#include "thesis/metric_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

#include "thesis/exact/lower_bound_formula-inl.hpp"

HWY_INLINE BasicPixelBox<Lanes> broadcast(const PixelBox& box) {
  return {Lanes(box.u_lo), Lanes(box.u_hi),       Lanes(box.v_lo),
          Lanes(box.v_hi), Lanes(box.depth_lo_m), Lanes(box.depth_hi_m)};
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
