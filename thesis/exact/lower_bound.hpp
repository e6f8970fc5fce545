// A lower bound of the metric over all pairs of two boxes of pixels: what branch and bound prunes
// with.
#pragma once

#include "thesis/metric.hpp"

namespace berth {

/// Pixels with u_lo <= u and u + 1 <= u_hi, the same in v (so the sides of all of them lie in
/// [u_lo, u_hi] x [v_lo, v_hi]), and depth in [depth_lo_m, depth_hi_m]. Without any pixel
/// depth_lo_m is +inf and depth_hi_m -inf.
template <class T>
struct BasicPixelBox {
  T u_lo;
  T u_hi;
  T v_lo;
  T v_hi;
  T depth_lo_m;
  T depth_hi_m;
};
using PixelBox = BasicPixelBox<float>;

template <class T>
struct Interval {
  T lo;
  T hi;
};

#include "thesis/exact/lower_bound_formula-inl.hpp"

}  // namespace berth
