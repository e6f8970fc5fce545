#include "berth/self_filter/edges.hpp"

#include <algorithm>
#include <cstddef>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/self_filter/edges.cpp"
#include "hwy/foreach_target.h"

#include "berth/self_filter/pixels-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// Readings and their neighbours: `step` counts elements to the next, 1 across, the stride along.
template <class D>
struct Line {
  const float* here;
  std::ptrdiff_t step;
  hn::Vec<D> before;
  hn::Vec<D> after;

  HWY_INLINE Line(D d, const float* at, std::ptrdiff_t to_next)
      : here(at),
        step(to_next),
        before(hn::LoadU(d, at - to_next)),
        after(hn::LoadU(d, at + to_next)) {}

  /// Holds wherever is_between does.
  HWY_INLINE hn::Mask<D> is_step(hn::Vec<D> reading, hn::Vec<D> jump) const {
    return hn::Gt(hn::Abs(hn::Sub(reading, before)), jump);
  }

  HWY_INLINE hn::Mask<D> is_between(hn::Vec<D> reading, hn::Vec<D> jump) const {
    return hn::And(hn::Gt(hn::Sub(reading, hn::Min(before, after)), jump),
                   hn::Gt(hn::Sub(hn::Max(before, after), reading), jump));
  }

  HWY_INLINE hn::Mask<D> is_flat(D d, hn::Vec<D> jump) const {
    const auto far_before = hn::LoadU(d, here - 2 * step);
    const auto far_after = hn::LoadU(d, here + 2 * step);
    return hn::And(hn::Le(hn::Abs(hn::Sub(before, far_before)), jump),
                   hn::Le(hn::Abs(hn::Sub(after, far_after)), jump));
  }
};

template <class D>
HWY_INLINE void mark(D d, const FilterRow& row, int u, hn::Mask<D> is_mixed) {
  const auto was = load_fate(d, row.fate + u);
  const auto changes = hn::And(is_mixed, has_fate(d, was, PixelFate::obstacle));
  store_fate(d, choose(d, changes, code(d, PixelFate::edge), was), row.fate + u);
  float* const depth_m = row.obstacle_depth_m + u;
  hn::StoreU(hn::IfThenElse(changes, hn::Set(d, kNoDepth), hn::LoadU(d, depth_m)), d, depth_m);
}

/// Looks at the lines with these steps through the pixels u_begin <= u < u_end, which have two
/// neighbours on both sides there.
template <class... Steps>
HWY_INLINE void mark_pixels(const FilterRow& row, int u_begin, int u_end, float jump_at_1m_m,
                            Steps... steps) {
  for_pixels(u_begin, u_end, [&](auto d, int u) HWY_ATTR {
    using D = decltype(d);
    const auto reading = hn::LoadU(d, row.reading_m + u);
    const auto jump =
        hn::Mul(hn::Set(d, jump_at_1m_m), hn::Max(hn::Set(d, 1.0F), hn::Mul(reading, reading)));
    const Line<D> lines[] = {Line<D>(d, row.reading_m + u, steps)...};
    auto is_step = lines[0].is_step(reading, jump);
    for (std::size_t i = 1; i < sizeof...(steps); ++i)
      is_step = hn::Or(is_step, lines[i].is_step(reading, jump));
    if (hn::AllFalse(d, is_step)) return;
    for (const Line<D>& line : lines)
      mark(d, row, u, hn::And(line.is_between(reading, jump), line.is_flat(d, jump)));
  });
}

void mark_row(const FilterRow& row, DepthView depth_m, int v, float jump_at_1m_m) {
  const int u_begin = std::min(2, depth_m.width);
  const int u_end = std::max(u_begin, depth_m.width - 2);
  const std::ptrdiff_t across = 1;
  if (v < 2 || v + 2 >= depth_m.height) {
    mark_pixels(row, u_begin, u_end, jump_at_1m_m, across);
    return;
  }
  mark_pixels(row, u_begin, u_end, jump_at_1m_m, across, depth_m.stride);
  mark_pixels(row, 0, u_begin, jump_at_1m_m, depth_m.stride);
  mark_pixels(row, u_end, depth_m.width, jump_at_1m_m, depth_m.stride);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(mark_row);

void mark_mixed_pixels(DepthView sensor_depth_m, int v, float edge_jump_m, const FilterRow& row) {
  HWY_DYNAMIC_DISPATCH(mark_row)(row, sensor_depth_m, v, edge_jump_m);
}

}  // namespace berth
#endif  // HWY_ONCE
