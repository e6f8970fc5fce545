#include "berth/self_filter/flying_patches.hpp"

#include <algorithm>
#include <bit>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/self_filter/beside_robot.cpp"
#include "hwy/foreach_target.h"

#include "berth/self_filter/pixels-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// The fates of a row, and of those above and below: the row itself at the image's border.
struct FateRows {
  const std::uint8_t* row[3];

  FateRows(const Image<PixelFate>& fate, int v) {
    for (int i = 0; i < 3; ++i) {
      const int n = std::clamp(v - 1 + i, 0, fate.height() - 1);
      row[i] = reinterpret_cast<const std::uint8_t*>(fate.row(n));
    }
  }
};

template <class D>
HWY_INLINE hn::Mask<D> is_fate(D d, hn::Vec<D> value, PixelFate fate) {
  return hn::Eq(value, hn::Set(d, static_cast<std::uint8_t>(fate)));
}

/// `left` and `right` are the steps to the neighbours, 0 at the image's border.
template <class D>
HWY_INLINE std::uint64_t bits_beside_robot(D d, const FateRows& rows, int u, int left, int right) {
  const auto shows_robot = [&](int i, int step) HWY_ATTR {
    return is_fate(d, hn::LoadU(d, rows.row[i] + u + step), PixelFate::robot);
  };
  const auto in_column = [&](int step) HWY_ATTR {
    return hn::Or(hn::Or(shows_robot(0, step), shows_robot(2, step)), shows_robot(1, step));
  };
  const auto is_beside = hn::Or(hn::Or(in_column(left), in_column(right)), in_column(0));
  if (hn::AllFalse(d, is_beside)) return 0;
  const auto value = hn::LoadU(d, rows.row[1] + u);
  const auto may_be_found =
      hn::Or(is_fate(d, value, PixelFate::padding), is_fate(d, value, PixelFate::obstacle));
  return bits_of(d, hn::And(is_beside, may_be_found));
}

void append_all(const Image<PixelFate>& fate, const PixelRect& pixels, std::vector<Pixel>& found) {
  const hn::ScalableTag<std::uint8_t> d;
  const hn::CappedTag<std::uint8_t, 1> one;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const int last = fate.width() - 1;
  const int u_begin = std::max(1, pixels.u_begin);
  const int u_end = std::min(last, pixels.u_end);
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    const FateRows rows(fate, v);
    const auto append = [&](int u, std::uint64_t bits) {
      for (; bits != 0; bits &= bits - 1) found.push_back({u + std::countr_zero(bits), v});
    };
    if (pixels.u_begin == 0) append(0, bits_beside_robot(one, rows, 0, 0, last > 0));
    int u = u_begin;
    for (; u + lanes <= u_end; u += lanes) append(u, bits_beside_robot(d, rows, u, -1, 1));
    // The last vector goes over some pixels a second time.
    if (u < u_end && u > u_begin) {
      append(u_end - lanes, bits_beside_robot(d, rows, u_end - lanes, -1, 1));
      u = u_end;
    }
    for (; u < u_end; ++u) append(u, bits_beside_robot(one, rows, u, -1, 1));
    if (pixels.u_end > last && last > 0) append(last, bits_beside_robot(one, rows, last, -1, 0));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(append_all);

void append_beside_robot(const Image<PixelFate>& fate, const PixelRect& pixels,
                         std::vector<Pixel>& found) {
  HWY_DYNAMIC_DISPATCH(append_all)(fate, pixels, found);
}

}  // namespace berth
#endif  // HWY_ONCE
