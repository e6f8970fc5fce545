// The depths of a tile as vectors, for the instruction set that the including file is being
// compiled for.
#if defined(BERTH_DISTANCE_TILE_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_TILE_LANES_INL_HPP
#undef BERTH_DISTANCE_TILE_LANES_INL_HPP
#else
#define BERTH_DISTANCE_TILE_LANES_INL_HPP
#endif

#include "berth/vector/lanes-inl.hpp"
#include "thesis/depth_tile.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// The numbers i, i + 1, ... of a tile by rows.
HWY_INLINE Lanes load_tile(const DepthSquare& tile, int i) {
  const float* x = tile.depth_m + i / kTilePx * tile.stride + i % kTilePx;
#if HWY_TARGET == HWY_SCALAR
  return load(x);
#else
  if constexpr (kLanes <= kTilePx) {
    return load(x);
  } else {
    const hn::Half<FloatTag> half;
    return hn::Combine(FloatTag(), hn::LoadU(half, x + tile.stride), hn::LoadU(half, x));
  }
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
