#include "berth/self_filter/rows.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/self_filter/rows.cpp"
#include "hwy/foreach_target.h"

#include "berth/self_filter/pixels-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

void copy_readings(const FilterRow& row, int u_begin, int u_end) {
  for_pixels(u_begin, u_end, [&](auto d, int u) HWY_ATTR {
    const auto reading = hn::LoadU(d, row.reading_m + u);
    store_fate(
        d,
        choose(d, hn::IsNaN(reading), code(d, PixelFate::no_reading), code(d, PixelFate::obstacle)),
        row.fate + u);
    hn::StoreU(reading, d, row.obstacle_depth_m + u);
  });
}

void classify(const FilterRow& row, int u_begin, int u_end, const Tolerance& tolerance) {
  for_pixels(u_begin, u_end, [&](auto d, int u) HWY_ATTR {
    const auto reading = hn::LoadU(d, row.reading_m + u);
    // The depth is NaN, and the comparison false, where there is no link.
    const auto on_model = belongs_to(d, reading, hn::LoadU(d, row.robot_depth_m + u), tolerance);
    auto value = choose(d, is_scenery(d, row.link_id + u), code(d, PixelFate::environment),
                        code(d, PixelFate::robot));
    value = choose(d, on_model, value, code(d, PixelFate::obstacle));
    value = choose(d, hn::IsNaN(reading), code(d, PixelFate::no_reading), value);
    store_fate(d, value, row.fate + u);
    hn::StoreU(hn::IfThenElse(on_model, hn::Set(d, kNoDepth), reading), d,
               row.obstacle_depth_m + u);
  });
}

void mark_mixed(const FilterRow& row, std::ptrdiff_t step, int u_begin, int u_end,
                float jump_at_1m_m) {
  for_pixels(u_begin, u_end, [&](auto d, int u) HWY_ATTR {
    const float* const here = row.reading_m + u;
    const auto reading = hn::LoadU(d, here);
    const auto before = hn::LoadU(d, here - step);
    const auto after = hn::LoadU(d, here + step);
    const auto jump =
        hn::Mul(hn::Set(d, jump_at_1m_m), hn::Max(hn::Set(d, 1.0F), hn::Mul(reading, reading)));
    const auto above_one = hn::Gt(hn::Sub(reading, hn::Min(before, after)), jump);
    const auto below_other = hn::Gt(hn::Sub(hn::Max(before, after), reading), jump);
    const auto between = hn::And(above_one, below_other);
    if (hn::AllFalse(d, between)) return;
    const auto flat_before = hn::Le(hn::Abs(hn::Sub(before, hn::LoadU(d, here - 2 * step))), jump);
    const auto flat_after = hn::Le(hn::Abs(hn::Sub(after, hn::LoadU(d, here + 2 * step))), jump);
    const auto was = load_fate(d, row.fate + u);
    const auto changes = hn::And(hn::And(between, hn::And(flat_before, flat_after)),
                                 has_fate(d, was, PixelFate::obstacle));
    store_fate(d, choose(d, changes, code(d, PixelFate::edge), was), row.fate + u);
    float* const depth_m = row.obstacle_depth_m + u;
    hn::StoreU(hn::IfThenElse(changes, hn::Set(d, kNoDepth), hn::LoadU(d, depth_m)), d, depth_m);
  });
}

void count_each(const PixelFate* fate, int width,
                std::array<std::int64_t, kPixelFateCount>& count) {
  const hn::ScalableTag<std::uint8_t> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  int u = 0;
  for (; u + lanes <= width; u += lanes) {
    const auto values = hn::LoadU(d, reinterpret_cast<const std::uint8_t*>(fate + u));
    for (int f = 0; f < kSelfFilterFateCount; ++f) {
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

HWY_EXPORT(copy_readings);
HWY_EXPORT(classify);
HWY_EXPORT(mark_mixed);
HWY_EXPORT(count_each);

void copy_row(const FilterRow& row, int u_begin, int u_end) {
  HWY_DYNAMIC_DISPATCH(copy_readings)(row, u_begin, u_end);
}

void classify_row(const FilterRow& row, int u_begin, int u_end, const Tolerance& tolerance) {
  HWY_DYNAMIC_DISPATCH(classify)(row, u_begin, u_end, tolerance);
}

void mark_mixed_row(const FilterRow& row, std::ptrdiff_t step, int u_begin, int u_end,
                    float jump_at_1m_m) {
  HWY_DYNAMIC_DISPATCH(mark_mixed)(row, step, u_begin, u_end, jump_at_1m_m);
}

void count_fates(const PixelFate* fate, int width,
                 std::array<std::int64_t, kPixelFateCount>& count) {
  HWY_DYNAMIC_DISPATCH(count_each)(fate, width, count);
}

}  // namespace berth
#endif  // HWY_ONCE
