// Lower bounds along the robot's surface instead of the camera's axes. Where two smooth surfaces
// lie equally far from each other everywhere, boxes along the camera's axes all overlap: a tilted
// surface fills much depth. Along the surface's normal they are thin.
#if defined(BERTH_DISTANCE_EXACT_ALIGNED_BOX_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_EXACT_ALIGNED_BOX_INL_HPP
#undef BERTH_DISTANCE_EXACT_ALIGNED_BOX_INL_HPP
#else
#define BERTH_DISTANCE_EXACT_ALIGNED_BOX_INL_HPP
#endif

#include <cmath>
#include <cstdint>

#include "thesis/exact/leaf_tile.hpp"
#include "thesis/exact/lower_bound_lanes-inl.hpp"
#include "thesis/exact/surface_axes.hpp"
#include "thesis/grid.hpp"
#include "thesis/tile_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

HWY_INLINE Lanes depths_of(const LeafTile& tile, int i) {
  return keep_where(tile.bits >> i, load_tile(tile.depths, i));
}

HWY_INLINE Lanes gap(const Interval<Lanes>& a, const Interval<Lanes>& b) {
  return greatest(Lanes(0), greatest(b.lo - a.hi, a.lo - b.hi));
}

/// The greater of x and `least`; NaN for NaN.
HWY_INLINE Lanes raised_to(Lanes least, Lanes x) {
  return hn::IfThenElse(hn::Lt(x.v, least.v), least.v, x.v);
}

/// A tile seen along axes. Pixels count at their depths, or at least at those of an interval: an
/// obstacle in front of the robot counts at the robot's depth.
class AlignedCamera {
 public:
  HWY_INLINE AlignedCamera(const Metric& metric, const Axes& axes, const LeafTile& tile,
                           Interval<float> raise_m)
      : tile_(tile), raise_m_(raise_m), is_raised_(tile.box.depth_lo_m < raise_m.hi) {
    const TileCorner corner = tile_corner(metric, tile.u, tile.v);
    for (int k = 0; k < 3; ++k) rate_[k] = rate_along(axes, k, corner);
  }

  /// The box around the pixels in `bits`.
  HWY_INLINE AlignedBox box_of(std::uint64_t bits) const {
    Lanes lo_m[3] = {Lanes(HUGE_VALF), Lanes(HUGE_VALF), Lanes(HUGE_VALF)};
    Lanes hi_m[3] = {Lanes(-HUGE_VALF), Lanes(-HUGE_VALF), Lanes(-HUGE_VALF)};
    for (int i = 0; i < kTilePixels; i += kLanes) {
      const Depths depth_m = depths(i, bits);
      for (int k = 0; k < 3; ++k) {
        const Interval<Lanes> span_m = span(k, i, depth_m);
        lo_m[k] = lesser_or_first(lo_m[k], span_m.lo);
        hi_m[k] = greater_or_first(hi_m[k], span_m.hi);
      }
    }
    AlignedBox box;
    for (int k = 0; k < 3; ++k) {
      box.lo_m[k] = least_lane(lo_m[k]);
      box.hi_m[k] = greatest_lane(hi_m[k]);
    }
    return box;
  }

  /// The pixels whose bound with the box lies below limit_m2.
  HWY_INLINE std::uint64_t pixels_near(const AlignedBox& box, float limit_m2) const {
    std::uint64_t bits = 0;
    for (int i = 0; i < kTilePixels; i += kLanes) {
      const Depths depth_m = depths(i, ~std::uint64_t{0});
      Lanes sum(0);
      for (int k = 0; k < 3; ++k) {
        const Interval<Lanes> span_m = span(k, i, depth_m);
        const Lanes gap_m = gap({Lanes(box.lo_m[k]), Lanes(box.hi_m[k])}, span_m);
        sum = sum + gap_m * gap_m;
      }
      const Lanes bound_m2 = sum * Lanes(kOrthonormal);
      // Not every instruction set keeps the NaN of a missing depth through `greatest`.
      bits |= (bits_less(bound_m2, Lanes(limit_m2)) & bits_less(Lanes(0), depth_m.far_m)) << i;
    }
    return bits;
  }

 private:
  struct Depths {
    Lanes near_m;
    Lanes far_m;
  };

  HWY_INLINE Depths depths(int i, std::uint64_t bits) const {
    const Lanes depth_m = keep_where((tile_.bits & bits) >> i, load_tile(tile_.depths, i));
    if (!is_raised_) return {depth_m, depth_m};
    return {raised_to(Lanes(raise_m_.lo), depth_m), raised_to(Lanes(raise_m_.hi), depth_m)};
  }

  /// A pixel's square spans its depth times the interval of rates. NaN without a depth.
  HWY_INLINE Interval<Lanes> span(int k, int i, const Depths& depth_m) const {
    const AxisRate& rate = rate_[k];
    const Lanes centre = Lanes(rate.first) + Lanes(rate.per_u) * load(kTileGrid.column + i) +
                         Lanes(rate.per_v) * load(kTileGrid.row + i);
    const Lanes lo = centre - Lanes(rate.half);
    const Lanes hi = centre + Lanes(rate.half);
    if (!is_raised_) return {lo * depth_m.near_m, hi * depth_m.near_m};
    return {least(lo * depth_m.near_m, lo * depth_m.far_m),
            greatest(hi * depth_m.near_m, hi * depth_m.far_m)};
  }

  const LeafTile& tile_;
  Interval<float> raise_m_;
  bool is_raised_;
  AxisRate rate_[3];
};

/// A lower bound of D^2 for a box and each of kLanes boxes, whose sides along axis k are lo_m[k]
/// and hi_m[k].
HWY_INLINE Lanes aligned_bound_m2(const AlignedBox& box, const float* const (&lo_m)[3],
                                  const float* const (&hi_m)[3]) {
  Lanes sum(0);
  for (int k = 0; k < 3; ++k) {
    const Lanes gap_m =
        gap({Lanes(box.lo_m[k]), Lanes(box.hi_m[k])}, {load(lo_m[k]), load(hi_m[k])});
    sum = sum + gap_m * gap_m;
  }
  return sum * Lanes(kOrthonormal);
}

/// The plane 1 / depth = a u + b v + c that fits the tile's pixels best.
HWY_INLINE InversePlane fit_plane(const LeafTile& tile) {
  Lanes sum[9] = {Lanes(0), Lanes(0), Lanes(0), Lanes(0), Lanes(0),
                  Lanes(0), Lanes(0), Lanes(0), Lanes(0)};
  for (int i = 0; i < kTilePixels; i += kLanes) {
    const Lanes depth_m = depths_of(tile, i);
    const auto there = hn::Eq(depth_m.v, depth_m.v);
    const auto w = hn::IfThenElseZero(there, hn::Div(Lanes(1).v, depth_m.v));
    const auto one = hn::IfThenElseZero(there, Lanes(1).v);
    const auto u = hn::IfThenElseZero(there, load(kTileGrid.column + i).v);
    const auto v = hn::IfThenElseZero(there, load(kTileGrid.row + i).v);
    const Lanes terms[9] = {
        one, u, v, hn::Mul(u, u), hn::Mul(u, v), hn::Mul(v, v), w, hn::Mul(u, w), hn::Mul(v, w)};
    for (int k = 0; k < 9; ++k) sum[k] = sum[k] + terms[k];
  }
  float total[9];
  for (int k = 0; k < 9; ++k) total[k] = sum_of_lanes(sum[k]);
  return solve_plane(total);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
