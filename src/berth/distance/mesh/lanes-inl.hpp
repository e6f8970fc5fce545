// Vectors of up to 16 floats, for the instruction set that the including file is being compiled
// for.
#if defined(BERTH_MESH_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_MESH_LANES_INL_HPP
#undef BERTH_MESH_LANES_INL_HPP
#else
#define BERTH_MESH_LANES_INL_HPP
#endif

#include <cstdint>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(FloatTag()));
using Mask = hn::Mask<FloatTag>;

struct Lanes {
  hn::Vec<FloatTag> v;
  HWY_INLINE Lanes(hn::Vec<FloatTag> x) : v(x) {}
  /// The same number in every lane.
  HWY_INLINE Lanes(float x) : v(hn::Set(FloatTag(), x)) {}
};

HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return hn::Add(a.v, b.v); }
HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return hn::Sub(a.v, b.v); }
HWY_INLINE Lanes operator-(Lanes a) { return hn::Neg(a.v); }
HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return hn::Mul(a.v, b.v); }
HWY_INLINE Lanes operator/(Lanes a, Lanes b) { return hn::Div(a.v, b.v); }
HWY_INLINE Mask operator<(Lanes a, Lanes b) { return hn::Lt(a.v, b.v); }
HWY_INLINE Mask operator<=(Lanes a, Lanes b) { return hn::Le(a.v, b.v); }
HWY_INLINE Mask operator>(Lanes a, Lanes b) { return hn::Gt(a.v, b.v); }
HWY_INLINE Mask operator>=(Lanes a, Lanes b) { return hn::Ge(a.v, b.v); }
HWY_INLINE Mask both(Mask a, Mask b) { return hn::And(a, b); }

HWY_INLINE Lanes mul_add(Lanes a, Lanes b, Lanes c) { return hn::MulAdd(a.v, b.v, c.v); }
HWY_INLINE Lanes least(Lanes a, Lanes b) { return hn::Min(a.v, b.v); }
HWY_INLINE Lanes greatest(Lanes a, Lanes b) { return hn::Max(a.v, b.v); }
HWY_INLINE Lanes clamp(Lanes x, Lanes lo, Lanes hi) { return least(greatest(x, lo), hi); }
HWY_INLINE Lanes abs(Lanes a) { return hn::Abs(a.v); }
HWY_INLINE Lanes root(Lanes a) { return hn::Sqrt(a.v); }
HWY_INLINE Lanes select(Mask mask, Lanes yes, Lanes no) {
  return hn::IfThenElse(mask, yes.v, no.v);
}

HWY_INLINE Lanes load(const float* x) { return hn::LoadU(FloatTag(), x); }
HWY_INLINE void store(Lanes x, float* out) { hn::StoreU(x.v, FloatTag(), out); }
/// first, first + 1, first + 2, ...
HWY_INLINE Lanes count_up(float first) { return hn::Iota(FloatTag(), first); }
HWY_INLINE float least_lane(Lanes x) { return hn::GetLane(hn::MinOfLanes(FloatTag(), x.v)); }
HWY_INLINE float greatest_lane(Lanes x) { return hn::GetLane(hn::MaxOfLanes(FloatTag(), x.v)); }

/// Bit i is set where lane i is.
HWY_INLINE std::uint32_t bits_of(Mask mask) {
  std::uint64_t bits = 0;
  hn::StoreMaskBits(FloatTag(), mask, reinterpret_cast<std::uint8_t*>(&bits));
  return static_cast<std::uint32_t>(bits);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#endif
