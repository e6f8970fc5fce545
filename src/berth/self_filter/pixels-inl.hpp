// Pixels of the self filter's images as vectors, for the instruction set that the including file is
// being compiled for.
#if defined(BERTH_SELF_FILTER_PIXELS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_SELF_FILTER_PIXELS_INL_HPP
#undef BERTH_SELF_FILTER_PIXELS_INL_HPP
#else
#define BERTH_SELF_FILTER_PIXELS_INL_HPP
#endif

#include <cstdint>

#include "berth/self_filter/settings.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"
#include "berth/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

static_assert(sizeof(PixelFate) == 1);

/// Calls action(tag, u) for whole vectors of pixels, and pixel by pixel where there are fewer. The
/// last vector goes over some pixels a second time, which action must not mind.
template <class Action>
HWY_INLINE void for_pixels(int u_begin, int u_end, const Action& action) {
  const int lanes = static_cast<int>(hn::Lanes(FloatTag()));
  int u = u_begin;
  for (; u + lanes <= u_end; u += lanes) action(FloatTag(), u);
  if (u == u_end) return;
  if (u > u_begin) return action(FloatTag(), u_end - lanes);
  for (; u < u_end; ++u) action(OneFloatTag(), u);
}

template <class D>
using FatesOf = hn::Vec<hn::Rebind<std::int32_t, D>>;

template <class D>
HWY_INLINE FatesOf<D> load_fate([[maybe_unused]] D d, const PixelFate* fate) {
  const hn::Rebind<std::int32_t, D> di;
  const hn::Rebind<std::uint8_t, D> db;
  return hn::PromoteTo(di, hn::LoadU(db, reinterpret_cast<const std::uint8_t*>(fate)));
}

template <class D>
HWY_INLINE void store_fate([[maybe_unused]] D d, FatesOf<D> value, PixelFate* fate) {
  const hn::Rebind<std::uint8_t, D> db;
  hn::StoreU(hn::DemoteTo(db, value), db, reinterpret_cast<std::uint8_t*>(fate));
}

template <class D>
HWY_INLINE FatesOf<D> code([[maybe_unused]] D d, PixelFate fate) {
  return hn::Set(hn::Rebind<std::int32_t, D>(), static_cast<std::int32_t>(fate));
}

template <class D>
HWY_INLINE hn::Mask<D> has_fate(D d, FatesOf<D> value, PixelFate fate) {
  return hn::RebindMask(d, hn::Eq(value, code(d, fate)));
}

template <class D>
HWY_INLINE FatesOf<D> choose([[maybe_unused]] D d, hn::Mask<D> where, FatesOf<D> yes,
                             FatesOf<D> no) {
  return hn::IfThenElse(hn::RebindMask(hn::Rebind<std::int32_t, D>(), where), yes, no);
}

template <class D>
HWY_INLINE hn::Mask<D> is_environment(D d, const LinkId* link_id) {
  const hn::Rebind<std::int32_t, D> di;
  const hn::Rebind<LinkId, D> dl;
  const auto id = hn::PromoteTo(di, hn::LoadU(dl, link_id));
  return hn::RebindMask(d, hn::Eq(id, hn::Set(di, std::int32_t{kEnvironmentLink})));
}

/// Whether readings belong to a surface of depth z, or lie behind it; false where one is NaN.
template <class D>
HWY_INLINE hn::Mask<D> belongs_to(D d, hn::Vec<D> reading, hn::Vec<D> z, const Tolerance& t) {
  const auto noise = hn::Mul(hn::Mul(hn::Set(d, t.per_m2), z), z);
  return hn::Ge(reading, hn::Sub(z, hn::Add(hn::Set(d, t.constant_m), noise)));
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif  // BERTH_SELF_FILTER_PIXELS_INL_HPP
