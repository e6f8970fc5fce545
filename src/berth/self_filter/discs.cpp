#include "berth/self_filter/discs.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "berth/self_filter/joined.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/self_filter/discs.cpp"
#include "hwy/foreach_target.h"

#include "berth/self_filter/pixels-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

template <class D>
HWY_INLINE hn::Mask<D> is_open(D d, const PixelFate* fate) {
  return has_fate(d, load_fate(d, fate), PixelFate::obstacle);
}

bool has_open(const PixelRect& rect, const Image<PixelFate>& fate) {
  bool found = false;
  for (int v = rect.v_begin; v < rect.v_end && !found; ++v) {
    for_pixels(rect.u_begin, rect.u_end, [&](auto d, int u) HWY_ATTR {
      found |= !hn::AllFalse(d, is_open(d, fate.row(v) + u));
    });
  }
  return found;
}

/// The image from (u, v) on; no reading beside it.
template <class D>
HWY_INLINE hn::Vec<D> load_at_border(D d, DepthView depth_m, int u, int v) {
  float readings_m[16];
  for (int i = 0; i < static_cast<int>(hn::Lanes(d)); ++i) {
    const bool is_inside = v >= 0 && v < depth_m.height && u + i >= 0 && u + i < depth_m.width;
    readings_m[i] = is_inside ? depth_m(u + i, v) : kNoDepth;
  }
  return hn::LoadU(d, readings_m);
}

/// `load(du, dv)` gives the neighbours.
template <class D, class Load>
HWY_INLINE hn::Mask<D> is_on_surface_of(D d, hn::Vec<D> reading_m, const Load& load) {
  const auto one = hn::Set(d, 1.0F);
  const auto jump_m =
      hn::Mul(hn::Set(d, kJoinedStep_m), hn::Max(one, hn::Mul(reading_m, reading_m)));
  auto joined = hn::Zero(d);
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      if (du == 0 && dv == 0) continue;
      const auto is_joined = hn::Le(hn::Abs(hn::Sub(load(du, dv), reading_m)), jump_m);
      joined = hn::Add(joined, hn::IfThenElseZero(is_joined, one));
    }
  }
  return hn::Ge(joined, hn::Set(d, static_cast<float>(kLeastOnSurface)));
}

template <class D>
HWY_INLINE hn::Mask<D> is_on_surface(D d, DepthView depth_m, int u, int v, hn::Vec<D> reading_m) {
  const int lanes = static_cast<int>(hn::Lanes(d));
  if (u > 0 && u + lanes < depth_m.width && v > 0 && v + 1 < depth_m.height) {
    const float* const here = depth_m.row(v) + u;
    return is_on_surface_of(d, reading_m, [&](int du, int dv) HWY_ATTR {
      return hn::LoadU(d, here + dv * depth_m.stride + du);
    });
  }
  return is_on_surface_of(d, reading_m, [&](int du, int dv) HWY_ATTR {
    return load_at_border(d, depth_m, u + du, v + dv);
  });
}

/// The readings of a tile that may be covered; NaN elsewhere, also beside the image's border, so
/// that all rows are whole vectors.
struct OpenReadings {
  alignas(64) float reading_m[kTileHeight_px][kTileWidth_px];
  /// The same, but below all depths where they are on no surface.
  alignas(64) float on_surface_m[kTileHeight_px][kTileWidth_px];
};

/// Which rows of the tile a disc may reach.
std::uint32_t rows_in_reach(const PixelRect& rect, const std::vector<NearDiscTile>& tiles) {
  std::uint32_t rows = 0;
  for (const NearDiscTile& near : tiles) {
    const auto [begin, end] = near.rows(rect);
    rows |= (1U << (end - rect.v_begin)) - (1U << (begin - rect.v_begin));
  }
  return rows;
}

/// Gives the bits of those that may be covered.
std::uint16_t read_row(const PixelRect& rect, int v, DepthView depth_m,
                       const Image<PixelFate>& fate, OpenReadings& open) {
  float* const reading_m = open.reading_m[v - rect.v_begin];
  float* const on_surface_m = open.on_surface_m[v - rect.v_begin];
  std::fill_n(reading_m, kTileWidth_px, kNoDepth);
  std::uint64_t bits = 0;
  for_pixels(rect.u_begin, rect.u_end, [&](auto d, int u) HWY_ATTR {
    const auto may_be_covered = is_open(d, fate.row(v) + u);
    if (hn::AllFalse(d, may_be_covered)) return;
    const auto read_m = hn::LoadU(d, depth_m.row(v) + u);
    const auto below_all = hn::Set(d, -std::numeric_limits<float>::infinity());
    const auto on_surface = is_on_surface(d, depth_m, u, v, read_m);
    hn::StoreU(hn::IfThenElse(may_be_covered, read_m, hn::Set(d, kNoDepth)), d,
               reading_m + (u - rect.u_begin));
    hn::StoreU(hn::IfThenElse(on_surface, read_m, below_all), d, on_surface_m + (u - rect.u_begin));
    bits |= bits_of(d, may_be_covered) << (u - rect.u_begin);
  });
  return static_cast<std::uint16_t>(bits);
}

/// Some pixels of one row.
template <class D>
struct PixelLanes {
  hn::Vec<D> u;
  hn::Vec<D> reading_m;
  hn::Vec<D> on_surface_m;
};

template <class D>
HWY_INLINE hn::Mask<D> in_depth(D d, const PixelLanes<D>& pixels, float least_m, float most_m) {
  return hn::And(hn::Ge(pixels.reading_m, hn::Set(d, least_m)),
                 hn::Le(pixels.on_surface_m, hn::Set(d, most_m)));
}

/// Those of `within` that no disc of the tile covers.
template <class D>
HWY_INLINE hn::Mask<D> not_covered(D d, const NearDiscTile& near, int v, hn::Mask<D> within,
                                   const PixelLanes<D>& pixels) {
  for (std::uint32_t i = 0; i < near.tile->count; ++i) {
    const Disc& disc = near.discs[i];
    const double dv = v - static_cast<double>(disc.v_px);
    const double width2_px2 = disc.radius2_px2 - disc.squash * dv * dv;
    if (width2_px2 < 0) continue;
    const auto du = hn::Sub(pixels.u, hn::Set(d, disc.u_px));
    // Squares of whole numbers: rounding down to one makes the comparison of floats exact.
    const auto whole = static_cast<float>(static_cast<std::int64_t>(width2_px2));
    const auto inside = hn::Le(hn::Mul(du, du), hn::Set(d, whole));
    within = hn::AndNot(hn::And(inside, in_depth(d, pixels, disc.least_m, disc.most_m)), within);
    if (hn::AllFalse(d, within)) break;
  }
  return within;
}

/// Makes NaN what the discs of a tile cover. `column` counts from the tile's left.
template <class D>
HWY_INLINE void cover(D d, const PixelRect& rect, int column, const NearDiscTile& near,
                      OpenReadings& open) {
  const DiscTile& tile = *near.tile;
  const auto u = hn::Iota(d, static_cast<float>(rect.u_begin + column));
  const auto left = hn::Sub(hn::Set(d, static_cast<float>(tile.bounds.u_begin)), u);
  const auto right = hn::Sub(u, hn::Set(d, static_cast<float>(tile.bounds.u_end - 1)));
  const auto du = hn::Max(hn::Zero(d), hn::Max(left, right));
  const auto du2 = hn::Mul(du, du);
  const auto [v_begin, v_end] = near.rows(rect);
  for (int v = v_begin; v < v_end; ++v) {
    float* const reading_m = open.reading_m[v - rect.v_begin] + column;
    const float* const on_surface_m = open.on_surface_m[v - rect.v_begin] + column;
    const PixelLanes<D> pixels{u, hn::LoadU(d, reading_m), hn::LoadU(d, on_surface_m)};
    const int dv = std::max({0, tile.bounds.v_begin - v, v - (tile.bounds.v_end - 1)});
    const auto in_reach = hn::Le(du2, hn::Set(d, static_cast<float>(tile.reach2_px2 - dv * dv)));
    const auto within = hn::And(in_reach, in_depth(d, pixels, tile.least_m, tile.most_m));
    if (hn::AllFalse(d, within)) continue;
    const auto covered = hn::AndNot(not_covered(d, near, v, within, pixels), within);
    hn::StoreU(hn::IfThenElse(covered, hn::Set(d, kNoDepth), pixels.reading_m), d, reading_m);
  }
}

TileBits cover_tile(const PixelRect& rect, const std::vector<NearDiscTile>& tiles,
                    DepthView sensor_depth_m, const Image<PixelFate>& fate) {
  const FloatTag d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const std::uint32_t rows = rows_in_reach(rect, tiles);
  OpenReadings open;
  TileBits bits{};
  for (std::uint32_t left = rows; left != 0; left &= left - 1) {
    const int row = std::countr_zero(left);
    bits[row] = read_row(rect, rect.v_begin + row, sensor_depth_m, fate, open);
  }
  for (const NearDiscTile& near : tiles) {
    for (int column = 0; column < kTileWidth_px; column += lanes)
      cover(d, rect, column, near, open);
  }
  for (std::uint32_t left = rows; left != 0; left &= left - 1) {
    const int row = std::countr_zero(left);
    std::uint64_t still_open = 0;
    for (int column = 0; column < kTileWidth_px; column += lanes) {
      const auto reading_m = hn::LoadU(d, open.reading_m[row] + column);
      still_open |= bits_of(d, hn::Eq(reading_m, reading_m)) << column;
    }
    bits[row] &= static_cast<std::uint16_t>(~still_open);
  }
  return bits;
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

TileBits covered_by_discs(const PixelRect& pixels, const std::vector<NearDiscTile>& tiles,
                          DepthView sensor_depth_m, const Image<PixelFate>& fate) {
  return HWY_DYNAMIC_DISPATCH(cover_tile)(pixels, tiles, sensor_depth_m, fate);
}

}  // namespace berth
#endif  // HWY_ONCE
