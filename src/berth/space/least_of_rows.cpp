#include "berth/space/least_of_rows.hpp"

#include <algorithm>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/space/least_of_rows.cpp"
#include "hwy/foreach_target.h"

#include "berth/space/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

void fill_each(int count, float* x) {
  for_row(
      0, count, [&](int i) { store(Lanes(kHoldsNothing_m), x + i); },
      [&](int i) { x[i] = kHoldsNothing_m; });
}

/// x[i] becomes the least of x[i] and from[i].
void take_least_each(const float* from, int width, float* x) {
  for_row(
      0, width, [&](int u) { store(least(load(x + u), load(from + u)), x + u); },
      [&](int u) { x[u] = std::min(x[u], from[u]); });
}

/// out[i] is the least of the three rows' i-th.
void take_least_of_three(const float* const (&rows)[3], int width, float* out) {
  for_row(
      0, width,
      [&](int u) {
        store(least(load(rows[0] + u), least(load(rows[1] + u), load(rows[2] + u))), out + u);
      },
      [&](int u) { out[u] = std::min(rows[0][u], std::min(rows[1][u], rows[2][u])); });
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(fill_each);
HWY_EXPORT(take_least_each);
HWY_EXPORT(take_least_of_three);

void fill_endless(int count, float* x) { HWY_DYNAMIC_DISPATCH(fill_each)(count, x); }

void take_least(const float* from, int count, float* x) {
  HWY_DYNAMIC_DISPATCH(take_least_each)(from, count, x);
}

void take_least_of(const float* const (&rows)[3], int count, float* out) {
  HWY_DYNAMIC_DISPATCH(take_least_of_three)(rows, count, out);
}

}  // namespace berth
#endif  // HWY_ONCE
