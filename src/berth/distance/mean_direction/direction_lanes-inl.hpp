// What the mean direction needs of vectors beyond vector/.
#if defined(BERTH_DISTANCE_DIRECTION_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_DIRECTION_LANES_INL_HPP
#undef BERTH_DISTANCE_DIRECTION_LANES_INL_HPP
#else
#define BERTH_DISTANCE_DIRECTION_LANES_INL_HPP
#endif

#include "berth/distance/metric_lanes-inl.hpp"
#include "berth/distance/tile_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// a b + c, in one rounding where the instruction set can: not the same bits everywhere.
HWY_INLINE Lanes multiply_add(Lanes a, Lanes b, Lanes c) { return hn::MulAdd(a.v, b.v, c.v); }
/// c - a b, likewise.
HWY_INLINE Lanes subtract_product(Lanes c, Lanes a, Lanes b) {
  return hn::NegMulAdd(a.v, b.v, c.v);
}

HWY_INLINE Lanes zero_unless(LaneMask mask, Lanes x) { return hn::IfThenElseZero(mask, x.v); }
HWY_INLINE Lanes choose(LaneMask mask, Lanes yes, Lanes no) {
  return hn::IfThenElse(mask, yes.v, no.v);
}

HWY_INLINE Lanes absolute(Lanes x) { return hn::Abs(x.v); }

/// 1 / sqrt(x) for normal x > 0, to 5e-5 or better (the worst is NEON's estimate of 8 bits); NaN
/// or infinity for 0.
HWY_INLINE Lanes inverse_square_root(Lanes x) {
  const Lanes estimate = hn::ApproximateReciprocalSqrt(x.v);
  const Lanes half_x = x * Lanes(0.5f);
  return estimate * subtract_product(Lanes(1.5f), half_x * estimate, estimate);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
