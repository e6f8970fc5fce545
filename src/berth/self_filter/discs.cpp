#include "berth/self_filter/discs.hpp"

#include <algorithm>
#include <limits>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/self_filter/discs.cpp"
#include "hwy/foreach_target.h"

#include "berth/self_filter/pixels-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

template <class D>
HWY_INLINE hn::Mask<D> is_open(D d, FatesOf<D> fate, PixelFate grown = PixelFate::padding) {
  const auto is_obstacle = has_fate(d, fate, PixelFate::obstacle);
  if (grown == PixelFate::island) return is_obstacle;
  return hn::Or(is_obstacle, has_fate(d, fate, PixelFate::edge));
}

bool has_open(const PixelRect& rect, const Image<PixelFate>& fate) {
  bool found = false;
  for (int v = rect.v_begin; v < rect.v_end && !found; ++v) {
    for_pixels(rect.u_begin, rect.u_end, [&](auto d, int u) HWY_ATTR {
      found |= !hn::AllFalse(d, is_open(d, load_fate(d, fate.row(v) + u)));
    });
  }
  return found;
}

/// Some pixels of one row that may be covered.
template <class D>
struct PixelLanes {
  int v;
  hn::Vec<D> u;
  hn::Vec<D> reading_m;
  /// The reading, below all depths where it is on no surface.
  hn::Vec<D> on_surface_m;
  hn::Mask<D> open;
};

/// The image from (u, v) on; no reading beside it.
template <class D>
HWY_INLINE hn::Vec<D> load_readings(D d, DepthView depth_m, int u, int v) {
  const int lanes = static_cast<int>(hn::Lanes(d));
  if (v < 0 || v >= depth_m.height) return hn::Set(d, kNoDepth);
  if (u >= 0 && u + lanes <= depth_m.width) return hn::LoadU(d, depth_m.row(v) + u);
  float readings_m[16];
  for (int i = 0; i < lanes; ++i) {
    readings_m[i] = u + i >= 0 && u + i < depth_m.width ? depth_m(u + i, v) : kNoDepth;
  }
  return hn::LoadU(d, readings_m);
}

template <class D>
HWY_INLINE hn::Mask<D> is_on_surface(D d, DepthView depth_m, int u, int v, hn::Vec<D> reading_m) {
  const auto one = hn::Set(d, 1.0F);
  const auto jump_m =
      hn::Mul(hn::Set(d, kSurfaceJump_m), hn::Max(one, hn::Mul(reading_m, reading_m)));
  auto joined = hn::Zero(d);
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      if (du == 0 && dv == 0) continue;
      const auto neighbour_m = load_readings(d, depth_m, u + du, v + dv);
      const auto is_joined = hn::Le(hn::Abs(hn::Sub(neighbour_m, reading_m)), jump_m);
      joined = hn::Add(joined, hn::IfThenElseZero(is_joined, one));
    }
  }
  return hn::Ge(joined, hn::Set(d, static_cast<float>(kLeastOnSurface)));
}

template <class D>
HWY_INLINE bool may_reach(D d, const PixelLanes<D>& pixels, const DiscTile& tile) {
  const PixelRect& bounds = tile.bounds;
  const auto dv =
      static_cast<float>(std::max({0, bounds.v_begin - pixels.v, pixels.v - (bounds.v_end - 1)}));
  const auto left = hn::Sub(hn::Set(d, static_cast<float>(bounds.u_begin)), pixels.u);
  const auto right = hn::Sub(pixels.u, hn::Set(d, static_cast<float>(bounds.u_end - 1)));
  const auto du = hn::Max(hn::Zero(d), hn::Max(left, right));
  const auto in_reach =
      hn::Le(hn::Mul(du, du), hn::Set(d, tile.reach_px * tile.reach_px - dv * dv));
  const auto in_depth = hn::And(hn::Ge(pixels.reading_m, hn::Set(d, tile.least_m)),
                                hn::Le(pixels.on_surface_m, hn::Set(d, tile.most_m)));
  return !hn::AllFalse(d, hn::And(pixels.open, hn::And(in_reach, in_depth)));
}

/// Closes the pixels that the disc covers.
template <class D>
HWY_INLINE void cover(D d, const Disc& disc, PixelLanes<D>& pixels) {
  const double dv = pixels.v - static_cast<double>(disc.v_px);
  const double width2 = disc.radius2_px2 - disc.squash * dv * dv;
  if (width2 < 0) return;
  const auto du = hn::Sub(pixels.u, hn::Set(d, disc.u_px));
  // Squares of whole numbers: rounding down to one makes the comparison of floats exact.
  const auto whole = static_cast<float>(static_cast<std::int64_t>(width2));
  const auto inside = hn::Le(hn::Mul(du, du), hn::Set(d, whole));
  const auto belongs = hn::And(hn::Ge(pixels.reading_m, hn::Set(d, disc.least_m)),
                               hn::Le(pixels.on_surface_m, hn::Set(d, disc.most_m)));
  pixels.open = hn::AndNot(hn::And(inside, belongs), pixels.open);
}

template <class D>
HWY_INLINE void cover_all(D d, const std::vector<NearDiscTile>& tiles, PixelLanes<D>& pixels) {
  for (const NearDiscTile& near : tiles) {
    if (!may_reach(d, pixels, *near.tile)) continue;
    for (std::uint32_t i = 0; i < near.tile->count; ++i) {
      cover(d, near.discs[i], pixels);
      if (hn::AllFalse(d, pixels.open)) return;
    }
  }
}

void cover_tile(const PixelRect& rect, const std::vector<NearDiscTile>& tiles, PixelFate grown,
                const GrownImages& images) {
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    for_pixels(rect.u_begin, rect.u_end, [&](auto d, int u) HWY_ATTR {
      using D = decltype(d);
      PixelFate* const fate = images.fate.row(v) + u;
      float* const depth_m = images.obstacle_depth_m.row(v) + u;
      const auto was = load_fate(d, fate);
      const auto open = is_open(d, was, grown);
      if (hn::AllFalse(d, open)) return;
      const auto reading_m = hn::LoadU(d, images.sensor_depth_m.row(v) + u);
      const auto below_all = hn::Set(d, -std::numeric_limits<float>::infinity());
      const auto on_surface = is_on_surface(d, images.sensor_depth_m, u, v, reading_m);
      PixelLanes<D> pixels{v, hn::Iota(d, static_cast<float>(u)), reading_m,
                           hn::IfThenElse(on_surface, reading_m, below_all), open};
      cover_all(d, tiles, pixels);
      const auto covered = hn::AndNot(pixels.open, open);
      store_fate(d, choose(d, covered, code(d, grown), was), fate);
      hn::StoreU(hn::IfThenElse(covered, hn::Set(d, kNoDepth), hn::LoadU(d, depth_m)), d, depth_m);
    });
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(cover_tile);
HWY_EXPORT(has_open);

bool may_be_covered(const PixelRect& pixels, const Image<PixelFate>& fate) {
  return HWY_DYNAMIC_DISPATCH(has_open)(pixels, fate);
}

void cover_with_discs(const PixelRect& pixels, const std::vector<NearDiscTile>& tiles,
                      PixelFate grown, const GrownImages& images) {
  HWY_DYNAMIC_DISPATCH(cover_tile)(pixels, tiles, grown, images);
}

}  // namespace berth
#endif  // HWY_ONCE
