#include "berth/self_filter/rows.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/self_filter/rows.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using OneFloat = hn::CappedTag<float, 1>;
static_assert(sizeof(PixelFate) == 1);

/// Calls action(tag, u) for whole vectors, then pixel by pixel.
template <class Action>
HWY_INLINE void for_pixels(int u_begin, int u_end, const Action& action) {
  const int lanes = static_cast<int>(hn::Lanes(Floats()));
  int u = u_begin;
  for (; u + lanes <= u_end; u += lanes) action(Floats(), u);
  for (; u < u_end; ++u) action(OneFloat(), u);
}

template <class D>
HWY_INLINE hn::Vec<D> load_fate([[maybe_unused]] D d, const PixelFate* fate) {
  const hn::Rebind<std::int32_t, D> di;
  const hn::Rebind<std::uint8_t, D> db;
  const auto bytes = hn::LoadU(db, reinterpret_cast<const std::uint8_t*>(fate));
  return hn::ConvertTo(d, hn::PromoteTo(di, bytes));
}

template <class D>
HWY_INLINE void store_fate([[maybe_unused]] D d, hn::Vec<D> value, PixelFate* fate) {
  const hn::Rebind<std::int32_t, D> di;
  const hn::Rebind<std::uint8_t, D> db;
  hn::StoreU(hn::DemoteTo(db, hn::ConvertTo(di, value)), db, reinterpret_cast<std::uint8_t*>(fate));
}

template <class D>
HWY_INLINE hn::Vec<D> code(D d, PixelFate fate) {
  return hn::Set(d, static_cast<float>(fate));
}

template <class D>
HWY_INLINE hn::Mask<D> belongs_to(D d, hn::Vec<D> reading, hn::Vec<D> z, const Tolerance& t) {
  const auto noise =
      hn::Add(hn::Mul(hn::Set(d, t.per_m), z), hn::Mul(hn::Mul(hn::Set(d, t.per_m2), z), z));
  return hn::Ge(reading, hn::Sub(z, hn::Add(hn::Set(d, t.constant_m), noise)));
}

void classify(const FilterRow& row, const Tolerance& tolerance, PixelFate* fate) {
  for_pixels(0, row.width, [&](auto d, int u) HWY_ATTR {
    const hn::Rebind<std::int32_t, decltype(d)> di;
    const hn::Rebind<LinkId, decltype(d)> dl;
    const auto reading = hn::LoadU(d, row.reading_m + u);
    const auto id = hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(dl, row.link_id + u)));
    const auto on_dilation =
        belongs_to(d, reading, hn::LoadU(d, row.dilated_depth_m + u), tolerance);
    const auto on_padding = belongs_to(d, reading, hn::LoadU(d, row.padded_depth_m + u), tolerance);
    // The depth is NaN, and the comparison false, where there is no link.
    const auto on_model = belongs_to(d, reading, hn::LoadU(d, row.robot_depth_m + u), tolerance);
    const auto is_scenery = hn::Eq(id, hn::Set(d, static_cast<float>(kEnvironmentLink)));
    auto value = code(d, PixelFate::obstacle);
    value = hn::IfThenElse(on_dilation, code(d, PixelFate::dilation), value);
    value = hn::IfThenElse(on_padding, code(d, PixelFate::padding), value);
    value = hn::IfThenElse(
        on_model,
        hn::IfThenElse(is_scenery, code(d, PixelFate::environment), code(d, PixelFate::robot)),
        value);
    value = hn::IfThenElse(hn::IsNaN(reading), code(d, PixelFate::no_reading), value);
    store_fate(d, value, fate + u);
  });
}

void mark_mixed(const float* reading_m, std::ptrdiff_t step, int u_begin, int u_end,
                float jump_at_1m_m, PixelFate* fate) {
  for_pixels(u_begin, u_end, [&](auto d, int u) HWY_ATTR {
    const auto reading = hn::LoadU(d, reading_m + u);
    const auto before = hn::LoadU(d, reading_m + u - step);
    const auto after = hn::LoadU(d, reading_m + u + step);
    const auto jump =
        hn::Mul(hn::Set(d, jump_at_1m_m), hn::Max(hn::Set(d, 1.0F), hn::Mul(reading, reading)));
    const auto flat_before =
        hn::Le(hn::Abs(hn::Sub(before, hn::LoadU(d, reading_m + u - 2 * step))), jump);
    const auto flat_after =
        hn::Le(hn::Abs(hn::Sub(after, hn::LoadU(d, reading_m + u + 2 * step))), jump);
    const auto above_one = hn::Gt(hn::Sub(reading, hn::Min(before, after)), jump);
    const auto below_other = hn::Gt(hn::Sub(hn::Max(before, after), reading), jump);
    const auto was = load_fate(d, fate + u);
    const auto is_mixed =
        hn::And(hn::And(flat_before, flat_after), hn::And(above_one, below_other));
    const auto changes = hn::And(is_mixed, hn::Eq(was, code(d, PixelFate::obstacle)));
    store_fate(d, hn::IfThenElse(changes, code(d, PixelFate::edge), was), fate + u);
  });
}

void keep(const float* reading_m, const PixelFate* fate, int width, float* obstacle_depth_m) {
  for_pixels(0, width, [&](auto d, int u) HWY_ATTR {
    const auto kept = hn::Eq(load_fate(d, fate + u), code(d, PixelFate::obstacle));
    hn::StoreU(hn::IfThenElse(kept, hn::LoadU(d, reading_m + u), hn::Set(d, kNoDepth)), d,
               obstacle_depth_m + u);
  });
}

void count_fates(const PixelFate* fate, int width,
                 std::array<std::int64_t, kPixelFateCount>& count) {
  const hn::ScalableTag<std::uint8_t> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  int u = 0;
  for (; u + lanes <= width; u += lanes) {
    const auto values = hn::LoadU(d, reinterpret_cast<const std::uint8_t*>(fate + u));
    for (int f = 0; f < kPixelFateCount; ++f) {
      count[f] += static_cast<std::int64_t>(
          hn::CountTrue(d, hn::Eq(values, hn::Set(d, static_cast<std::uint8_t>(f)))));
    }
  }
  for (; u < width; ++u) ++count[static_cast<std::size_t>(fate[u])];
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(classify);
HWY_EXPORT(mark_mixed);
HWY_EXPORT(keep);
HWY_EXPORT(count_fates);

void classify_row(const FilterRow& row, const Tolerance& tolerance, PixelFate* fate) {
  HWY_DYNAMIC_DISPATCH(classify)(row, tolerance, fate);
}

void mark_mixed_row(const float* reading_m, std::ptrdiff_t step, int u_begin, int u_end,
                    float jump_at_1m_m, PixelFate* fate) {
  HWY_DYNAMIC_DISPATCH(mark_mixed)(reading_m, step, u_begin, u_end, jump_at_1m_m, fate);
}

void keep_obstacle_row(const float* reading_m, const PixelFate* fate, int width,
                       float* obstacle_depth_m, std::array<std::int64_t, kPixelFateCount>& count) {
  HWY_DYNAMIC_DISPATCH(keep)(reading_m, fate, width, obstacle_depth_m);
  HWY_DYNAMIC_DISPATCH(count_fates)(fate, width, count);
}

}  // namespace berth
#endif  // HWY_ONCE
