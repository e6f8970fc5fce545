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
    auto value = choose(d, is_environment(d, row.link_id + u), code(d, PixelFate::environment),
                        code(d, PixelFate::robot));
    value = choose(d, on_model, value, code(d, PixelFate::obstacle));
    value = choose(d, hn::IsNaN(reading), code(d, PixelFate::no_reading), value);
    store_fate(d, value, row.fate + u);
    hn::StoreU(hn::IfThenElse(on_model, hn::Set(d, kNoDepth), reading), d,
               row.obstacle_depth_m + u);
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
HWY_EXPORT(count_each);

void copy_row(const FilterRow& row, int u_begin, int u_end) {
  HWY_DYNAMIC_DISPATCH(copy_readings)(row, u_begin, u_end);
}

void classify_row(const FilterRow& row, int u_begin, int u_end, const Tolerance& tolerance) {
  HWY_DYNAMIC_DISPATCH(classify)(row, u_begin, u_end, tolerance);
}

void count_fates(const PixelFate* fate, int width,
                 std::array<std::int64_t, kPixelFateCount>& count) {
  HWY_DYNAMIC_DISPATCH(count_each)(fate, width, count);
}

}  // namespace berth
#endif  // HWY_ONCE
