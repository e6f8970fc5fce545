// Vectors of up to 16 floats as the Number of metric_formula-inl.hpp, for the instruction set
// that the including file is being compiled for.
#if defined(BERTH_DISTANCE_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_LANES_INL_HPP
#undef BERTH_DISTANCE_LANES_INL_HPP
#else
#define BERTH_DISTANCE_LANES_INL_HPP
#endif

#include <cstdint>

#include "berth/distance/depth_tile.hpp"
#include "berth/distance/lower_bound.hpp"
#include "berth/types/image.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(FloatTag()));

struct Lanes {
  hn::Vec<FloatTag> v;
  HWY_INLINE Lanes(hn::Vec<FloatTag> x) : v(x) {}
  /// The same number in every lane.
  HWY_INLINE explicit Lanes(float x) : v(hn::Set(FloatTag(), x)) {}
};

HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return hn::Add(a.v, b.v); }
HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return hn::Sub(a.v, b.v); }
HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return hn::Mul(a.v, b.v); }
HWY_INLINE Lanes least(Lanes a, Lanes b) { return hn::Min(a.v, b.v); }
HWY_INLINE Lanes greatest(Lanes a, Lanes b) { return hn::Max(a.v, b.v); }
HWY_INLINE Lanes positive_part(Lanes x) {
  return hn::IfThenZeroElse(hn::Lt(x.v, hn::Zero(FloatTag())), x.v);
}

using Number = Lanes;
#include "berth/distance/metric_formula-inl.hpp"

#include "berth/distance/lower_bound_formula-inl.hpp"

HWY_INLINE Lanes load(const float* x) { return hn::LoadU(FloatTag(), x); }
HWY_INLINE void store(Lanes x, float* out) { hn::StoreU(x.v, FloatTag(), out); }

/// The first `count` numbers; NaN in the lanes beyond.
HWY_INLINE Lanes load_first(const float* x, int count) {
  if (count >= kLanes) return load(x);
  alignas(64) float padded[kLanes];
  for (int i = 0; i < kLanes; ++i) padded[i] = i < count ? x[i] : kNoDepth;
  return load(padded);
}

/// The lanes whose bit is set; NaN in the others.
HWY_INLINE Lanes keep_where(std::uint64_t bits, Lanes x) {
  const auto mask = hn::LoadMaskBits(FloatTag(), reinterpret_cast<const std::uint8_t*>(&bits));
  return hn::IfThenElse(mask, x.v, Lanes(kNoDepth).v);
}

/// Numbers 0, 2, 4, ... of the 2 kLanes from x on.
HWY_INLINE Lanes load_even(const float* x) {
#if HWY_TARGET == HWY_SCALAR
  return load(x);
#else
  return hn::ConcatEven(FloatTag(), load(x + kLanes).v, load(x).v);
#endif
}

/// Numbers 1, 3, 5, ... of the 2 kLanes from x on.
HWY_INLINE Lanes load_odd(const float* x) {
#if HWY_TARGET == HWY_SCALAR
  return load(x + 1);
#else
  return hn::ConcatOdd(FloatTag(), load(x + kLanes).v, load(x).v);
#endif
}

/// The numbers i, i + 1, ... of a tile by rows.
HWY_INLINE Lanes load_tile(const TileDepths& tile, int i) {
  const float* x = tile.depth_m + i / kTilePx * tile.stride + i % kTilePx;
#if HWY_TARGET == HWY_SCALAR
  return load(x);
#else
  if constexpr (kLanes <= kTilePx) {
    return load(x);
  } else {
    const hn::Half<FloatTag> half;
    return hn::Combine(FloatTag(), hn::LoadU(half, x + tile.stride), hn::LoadU(half, x));
  }
#endif
}

/// first, first + 1, first + 2, ...
HWY_INLINE Lanes count_up(float first) { return hn::Iota(FloatTag(), first); }

HWY_INLINE BasicMetric<Lanes> broadcast(const Metric& m) {
  return {Lanes(m.cx_px), Lanes(m.cy_px), Lanes(m.inv_fx), Lanes(m.inv_fy)};
}

HWY_INLINE BasicPixelBox<Lanes> broadcast(const PixelBox& box) {
  return {Lanes(box.u_lo), Lanes(box.u_hi),       Lanes(box.v_lo),
          Lanes(box.v_hi), Lanes(box.depth_lo_m), Lanes(box.depth_hi_m)};
}

/// Lane by lane b where it is less than a, and a where it is not or either is NaN.
HWY_INLINE Lanes lesser_or_first(Lanes a, Lanes b) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SCALAR
  return hn::Min(b.v, a.v);  // Of a pair with NaN, x86 takes the second.
#else
  return hn::IfThenElse(hn::Lt(b.v, a.v), b.v, a.v);
#endif
}

/// Lane by lane b where it is greater than a, and a where it is not or either is NaN.
HWY_INLINE Lanes greater_or_first(Lanes a, Lanes b) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SCALAR
  return hn::Max(b.v, a.v);
#else
  return hn::IfThenElse(hn::Gt(b.v, a.v), b.v, a.v);
#endif
}

HWY_INLINE float least_lane(Lanes x) { return hn::GetLane(hn::MinOfLanes(FloatTag(), x.v)); }

HWY_INLINE float greatest_lane(Lanes x) { return hn::GetLane(hn::MaxOfLanes(FloatTag(), x.v)); }
HWY_INLINE float sum_of_lanes(Lanes x) { return hn::GetLane(hn::SumOfLanes(FloatTag(), x.v)); }

/// Bit i is set where a < b in lane i; not where either is NaN.
HWY_INLINE std::uint64_t bits_less(Lanes a, Lanes b) {
  std::uint64_t bits = 0;
  hn::StoreMaskBits(FloatTag(), hn::Lt(a.v, b.v), reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
