// Rows of pixels, many lanes at a time.
#if defined(BERTH_MESH_ROWS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_MESH_ROWS_INL_HPP
#undef BERTH_MESH_ROWS_INL_HPP
#else
#define BERTH_MESH_ROWS_INL_HPP
#endif

#include <algorithm>

#include "berth/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// A vector of 16-bit numbers.
using ShortTag = hn::CappedTag<std::uint16_t, 32>;
using Shorts = hn::Vec<ShortTag>;
constexpr int kShorts = static_cast<int>(hn::MaxLanes(ShortTag()));

HWY_INLINE Shorts load_shorts(const std::uint16_t* x) { return hn::LoadU(ShortTag(), x); }
HWY_INLINE void store_shorts(Shorts x, std::uint16_t* out) { hn::StoreU(x, ShortTag(), out); }

/// Calls many(i) for `count` numbers from i on until all of [begin, end) had their turn, some of
/// them twice; one(i) where there are fewer than `count`.
template <int count = kLanes, class Many, class One>
HWY_INLINE void for_row(int begin, int end, Many many, One one) {
  if (end - begin < count) {
    for (int i = begin; i < end; ++i) one(i);
    return;
  }
  for (int i = begin; i <= end - count; i += count) many(i);
  if ((end - begin) % count != 0) many(end - count);
}

/// `wanted` numbers: those of the row, or where it has only `count` of them, a copy in `padded`
/// that repeats the last one, which changes no least and no greatest.
HWY_INLINE const float* padded_row(const float* row, int count, int wanted, float* padded) {
  if (count >= wanted) return row;
  std::copy_n(row, count, padded);
  std::fill(padded + count, padded + wanted, row[count - 1]);
  return padded;
}

/// The least of each two neighbours, in place; `count` is a multiple of 2 kLanes.
HWY_INLINE void halve_to_least(float* x, int count) {
  for (int i = 0; i < count / 2; i += kLanes) {
    store(least(load_even(x + 2 * i), load_odd(x + 2 * i)), x + i);
  }
}

HWY_INLINE void halve_to_greatest(float* x, int count) {
  for (int i = 0; i < count / 2; i += kLanes) {
    store(greatest(load_even(x + 2 * i), load_odd(x + 2 * i)), x + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
