// Inside space/ only: the least of rows of numbers.
#pragma once

#include <limits>

namespace berth {

/// What holds nothing.
inline constexpr float kHoldsNothing_m = std::numeric_limits<float>::max();

void fill_endless(int count, float* x);
/// x[i] becomes the least of x[i] and from[i].
void take_least(const float* from, int count, float* x);
/// out[i] is the least of the three rows' i-th.
void take_least_of(const float* const (&rows)[3], int count, float* out);

}  // namespace berth
