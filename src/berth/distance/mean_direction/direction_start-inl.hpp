// Where directions start, and their sum, in vectors.
#if defined(BERTH_DISTANCE_DIRECTION_START_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_DIRECTION_START_INL_HPP
#undef BERTH_DISTANCE_DIRECTION_START_INL_HPP
#else
#define BERTH_DISTANCE_DIRECTION_START_INL_HPP
#endif

#include "berth/distance/mean_direction/direction_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// A robot pixel, and which obstacle pixels count for it.
struct Start {
  Lanes u;
  Lanes v;
  Lanes depth_m;
  Lanes max_depth_m;
  PixelRect rect;
  /// Whether the image has pixels outside of `rect`.
  bool is_cut;
};

/// The sum of unit vectors and their number, lane by lane.
struct LaneSums {
  Lanes x;
  Lanes y;
  Lanes z;
  Lanes count;
  /// A bound of what the sum is wrong by.
  Lanes error;
  /// Unit vectors that `count` leaves out.
  std::size_t pixels;
};

HWY_INLINE LaneSums no_directions() {
  return {Lanes(0), Lanes(0), Lanes(0), Lanes(0), Lanes(0), 0};
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
