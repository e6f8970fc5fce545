// Vectors of up to 16 floats, for the instruction set that the including file is being compiled
// for. Everything here gives the same bits on all of them, unless its comment says otherwise.
#if defined(BERTH_VECTOR_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_VECTOR_LANES_INL_HPP
#undef BERTH_VECTOR_LANES_INL_HPP
#else
#define BERTH_VECTOR_LANES_INL_HPP
#endif

#include <cstdint>
#include <limits>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Highway's own names for a vector of floats and what compares two; Lanes has operators instead.
using FloatTag = hn::CappedTag<float, 16>;
using FloatVector = hn::Vec<FloatTag>;
using LaneMask = hn::Mask<FloatTag>;
/// A vector of one, for what is left over at the end of a row.
using OneFloatTag = hn::CappedTag<float, 1>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(FloatTag()));

/// Bit i is lane i of a mask of the tag's vectors, of at most 64 lanes.
template <class Tag>
HWY_INLINE std::uint64_t bits_of(Tag d, hn::Mask<Tag> mask) {
  std::uint64_t bits = 0;
  hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits & (~std::uint64_t{0} >> (64 - hn::Lanes(d)));
}
HWY_INLINE std::uint64_t bits_of(LaneMask mask) { return bits_of(FloatTag(), mask); }

struct Lanes {
  FloatVector v;
  HWY_INLINE Lanes(FloatVector x) : v(x) {}
  /// The same number in every lane.
  HWY_INLINE explicit Lanes(float x) : v(hn::Set(FloatTag(), x)) {}
};

HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return hn::Add(a.v, b.v); }
HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return hn::Sub(a.v, b.v); }
HWY_INLINE Lanes operator-(Lanes a) { return hn::Neg(a.v); }
HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return hn::Mul(a.v, b.v); }
HWY_INLINE Lanes operator/(Lanes a, Lanes b) { return hn::Div(a.v, b.v); }
/// A comparison with NaN does not hold.
HWY_INLINE LaneMask operator<(Lanes a, Lanes b) { return hn::Lt(a.v, b.v); }
HWY_INLINE LaneMask operator<=(Lanes a, Lanes b) { return hn::Le(a.v, b.v); }
HWY_INLINE LaneMask operator>(Lanes a, Lanes b) { return hn::Gt(a.v, b.v); }
HWY_INLINE LaneMask operator>=(Lanes a, Lanes b) { return hn::Ge(a.v, b.v); }
HWY_INLINE LaneMask both(LaneMask a, LaneMask b) { return hn::And(a, b); }
HWY_INLINE Lanes select(LaneMask mask, Lanes yes, Lanes no) {
  return hn::IfThenElse(mask, yes.v, no.v);
}
/// +inf for NaN.
HWY_INLINE Lanes nan_to_infinity(Lanes x) {
  return select(hn::Eq(x.v, x.v), x, Lanes(std::numeric_limits<float>::infinity()));
}
/// a b + c, rounded once or twice, as the instruction set has it: not the same bits.
HWY_INLINE Lanes mul_add(Lanes a, Lanes b, Lanes c) { return hn::MulAdd(a.v, b.v, c.v); }
HWY_INLINE Lanes abs(Lanes a) { return hn::Abs(a.v); }
HWY_INLINE Lanes root(Lanes a) { return hn::Sqrt(a.v); }
/// For NaN different on different instruction sets, as `greatest`.
HWY_INLINE Lanes least(Lanes a, Lanes b) { return hn::Min(a.v, b.v); }
HWY_INLINE Lanes greatest(Lanes a, Lanes b) { return hn::Max(a.v, b.v); }
HWY_INLINE Lanes clamp(Lanes x, Lanes lo, Lanes hi) { return least(greatest(x, lo), hi); }
/// max(0, x), and NaN for NaN.
HWY_INLINE Lanes positive_part(Lanes x) {
  return hn::IfThenZeroElse(hn::Lt(x.v, hn::Zero(FloatTag())), x.v);
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

HWY_INLINE Lanes load(const float* x) { return hn::LoadU(FloatTag(), x); }
HWY_INLINE void store(Lanes x, float* out) { hn::StoreU(x.v, FloatTag(), out); }

/// The first `count` numbers; NaN in the lanes beyond.
HWY_INLINE Lanes load_first(const float* x, int count) {
  if (count >= kLanes) return load(x);
  alignas(64) float padded[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    padded[i] = i < count ? x[i] : std::numeric_limits<float>::quiet_NaN();
  }
  return load(padded);
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

/// The lanes whose bit is set; NaN in the others.
HWY_INLINE Lanes keep_where(std::uint64_t bits, Lanes x) {
  const auto mask = hn::LoadMaskBits(FloatTag(), reinterpret_cast<const std::uint8_t*>(&bits));
  return hn::IfThenElse(mask, x.v, Lanes(std::numeric_limits<float>::quiet_NaN()).v);
}

/// first, first + 1, first + 2, ...
HWY_INLINE Lanes count_up(float first) { return hn::Iota(FloatTag(), first); }

HWY_INLINE float least_lane(Lanes x) { return hn::GetLane(hn::MinOfLanes(FloatTag(), x.v)); }
HWY_INLINE float greatest_lane(Lanes x) { return hn::GetLane(hn::MaxOfLanes(FloatTag(), x.v)); }
/// Added up in another order on each instruction set: not the same bits.
HWY_INLINE float sum_of_lanes(Lanes x) { return hn::GetLane(hn::SumOfLanes(FloatTag(), x.v)); }

/// Bit i is set where a < b in lane i; not where either is NaN.
HWY_INLINE std::uint64_t bits_less(Lanes a, Lanes b) { return bits_of(hn::Lt(a.v, b.v)); }

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
