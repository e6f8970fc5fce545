#include "berth/space/free_depth.hpp"

#include <algorithm>
#include <cmath>

#ifndef BERTH_FREE_DEPTH_ROW
#define BERTH_FREE_DEPTH_ROW
namespace berth {
/// A row of S, of F, and of the fates' numbers.
struct FreeDepthRow {
  const float* sensed_m = nullptr;
  const float* obstacle_m = nullptr;
  const std::uint8_t* fate = nullptr;
  /// Null where nothing is known of the environment.
  const float* environment_back_m = nullptr;
};

/// The same in units, and what each pixel hides and frees.
struct UnitRow {
  DepthUnits* sensed = nullptr;
  DepthUnits* hidden = nullptr;
  DepthUnits* own = nullptr;
};
/// Of SpaceSettings.
struct SpaceLengths {
  float margin_m = 0;
  float behind_m = 0;
  float thickness_m = 0;
};

/// Up to where a pixel frees.
enum class Frees {
  before_obstacle,
  before_reading,
  behind_robot,
  environment,
  background,
  as_hole
};

/// The one place where a fate becomes a rule: a new fate does not compile before it has one.
constexpr Frees frees(PixelFate fate) {
  switch (fate) {
    case PixelFate::obstacle:
    case PixelFate::no_reading:
      return Frees::before_obstacle;
    case PixelFate::flying_patch:
    case PixelFate::outside_region:
    case PixelFate::soft:
    case PixelFate::speckle:
      return Frees::before_reading;
    case PixelFate::robot:
    case PixelFate::padding:
      return Frees::behind_robot;
    case PixelFate::environment:
      return Frees::environment;
    case PixelFate::background:
      return Frees::background;
    case PixelFate::hole:
      return Frees::as_hole;
  }
  return Frees::as_hole;
}

/// Bit i: of fate i.
constexpr std::int32_t bit_of(PixelFate fate) { return 1 << static_cast<int>(fate); }
constexpr std::int32_t fates_that_free(Frees rule) {
  std::int32_t fates = 0;
  for (int i = 0; i < kPixelFateCount; ++i) {
    const auto fate = static_cast<PixelFate>(i);
    if (frees(fate) == rule) fates |= bit_of(fate);
  }
  return fates;
}
}  // namespace berth
#endif

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/space/free_depth.cpp"
#include "hwy/foreach_target.h"

#include "berth/space/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

using FateTag = hn::Rebind<std::uint8_t, FloatTag>;
using WholeTag = hn::Rebind<std::int32_t, FloatTag>;

HWY_INLINE LaneMask is_nan(Lanes x) { return hn::Not(hn::Eq(x.v, x.v)); }

/// What kLanes pixels say.
struct FreeDepthPixels {
  Lanes sensed_m;
  Lanes obstacle_m;
  /// bit_of() each fate.
  hn::Vec<WholeTag> fate_bit;
  /// 0 where it is not known.
  Lanes environment_back_m;

  HWY_INLINE FreeDepthPixels(const FreeDepthRow& row, int u)
      : sensed_m(load(row.sensed_m + u)),
        obstacle_m(load(row.obstacle_m + u)),
        fate_bit(hn::Shl(hn::Set(WholeTag(), 1),
                         hn::PromoteTo(WholeTag(), hn::LoadU(FateTag(), row.fate + u)))),
        environment_back_m(0.0f) {
    if (row.environment_back_m == nullptr) return;
    const Lanes back_m = load(row.environment_back_m + u);
    environment_back_m = hn::IfThenZeroElse(is_nan(back_m), back_m.v);
  }

  HWY_INLINE LaneMask is_one_of(std::int32_t fates) const {
    const auto theirs = hn::And(fate_bit, hn::Set(WholeTag(), fates));
    return hn::RebindMask(FloatTag(), hn::Eq(theirs, fate_bit));
  }
  template <Frees rule>
  HWY_INLINE LaneMask frees_by() const {
    constexpr std::int32_t kFates = fates_that_free(rule);
    return is_one_of(kFates);
  }
  HWY_INLINE Lanes of_environment_m(float margin_m, Lanes most_m) const {
    return greater_or_first(sensed_m - Lanes(margin_m), least(most_m, environment_back_m));
  }
  HWY_INLINE LaneMask is_hole() const {
    return hn::Or(hn::And(is_nan(sensed_m), is_nan(obstacle_m)), frees_by<Frees::as_hole>());
  }
  HWY_INLINE Lanes hides_from_m(float thickness_m) const {
    return hn::IfThenElse(is_one_of(bit_of(PixelFate::flying_patch)), sensed_m.v,
                          (obstacle_m + Lanes(thickness_m)).v);
  }
};

/// units_of(), but `of_nan` for NaN.
HWY_INLINE void store_units(Lanes depth_m, DepthUnits of_nan, DepthUnits* out) {
  using HalfTag = hn::Rebind<DepthUnits, FloatTag>;
  const Lanes units = clamp(depth_m * Lanes(kUnitsPerMetre), Lanes(0.0f), Lanes(float(kMostUnits)));
  const auto whole =
      hn::ConvertTo(WholeTag(), select(is_nan(depth_m), Lanes(float(of_nan)), units).v);
  hn::StoreU(hn::DemoteTo(HalfTag(), whole), HalfTag(), out);
}

/// own_of_pixel() of many; `of_hole` where there is neither a reading nor an obstacle.
void fill_own(const FreeDepthRow& row, int width, const SpaceLengths& lengths, DepthUnits of_hole,
              const UnitRow& out) {
  for_row(
      0, width,
      [&](int u) {
        const FreeDepthPixels pixels(row, u);
        store_units(pixels.sensed_m, kEndlessUnits, out.sensed + u);
        store_units(pixels.hides_from_m(lengths.thickness_m), kEndlessUnits, out.hidden + u);
        const Lanes robot_m = pixels.sensed_m + Lanes(lengths.behind_m);
        const Lanes before_m = pixels.obstacle_m - Lanes(lengths.margin_m);
        const Lanes background_m =
            hn::IfThenZeroElse(is_nan(pixels.sensed_m), lesser_or_first(before_m, robot_m).v);
        auto own = hn::IfThenElse(pixels.frees_by<Frees::background>(), background_m.v, before_m.v);
        own = hn::IfThenElse(pixels.frees_by<Frees::behind_robot>(), robot_m.v, own);
        own = hn::IfThenElse(pixels.frees_by<Frees::environment>(),
                             pixels.of_environment_m(lengths.margin_m, robot_m).v, own);
        own = hn::IfThenElse(pixels.frees_by<Frees::before_reading>(),
                             (pixels.sensed_m - Lanes(lengths.margin_m)).v, own);
        // A hole is NaN, and what else is NaN frees nothing.
        own = hn::IfThenZeroElse(is_nan(own), own);
        own = hn::IfThenElse(pixels.is_hole(), hn::NaN(FloatTag()), own);
        store_units(own, of_hole, out.own + u);
      },
      [](int) {});
}

/// The least of 3 x 3 pixels in the columns [1, width - 1).
void fill_least(const DepthUnits* above, const DepthUnits* middle, const DepthUnits* below,
                int width, DepthUnits* out) {
  const auto of_column = [&](int u) {
    return hn::Min(hn::Min(load_shorts(above + u), load_shorts(middle + u)),
                   load_shorts(below + u));
  };
  for_row<kShorts>(
      1, width - 1,
      [&](int u) {
        store_shorts(hn::Min(hn::Min(of_column(u - 1), of_column(u)), of_column(u + 1)), out + u);
      },
      [&](int u) {
        DepthUnits all = kEndlessUnits;
        for (const DepthUnits* row : {above, middle, below}) {
          all = std::min({all, row[u - 1], row[u], row[u + 1]});
        }
        out[u] = all;
      });
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(fill_own);
HWY_EXPORT(fill_least);

namespace {

float own_of_reading(float sensed_m, float obstacle_m, float environment_back_m, PixelFate fate,
                     const SpaceLengths& lengths) {
  const auto [margin_m, behind_m, thickness_m] = lengths;
  switch (frees(fate)) {
    case Frees::background:
      return std::isnan(sensed_m) ? 0 : std::min(obstacle_m - margin_m, sensed_m + behind_m);
    case Frees::environment: {
      const float back_m = std::isnan(environment_back_m) ? 0 : environment_back_m;
      return std::max(sensed_m - margin_m, std::min(sensed_m + behind_m, back_m));
    }
    case Frees::behind_robot:
      return sensed_m + behind_m;
    case Frees::before_reading:
      return sensed_m - margin_m;
    case Frees::before_obstacle:
    case Frees::as_hole:
      break;
  }
  return obstacle_m - margin_m;
}

/// Pixel u of a row.
DepthUnits own_of_pixel(const FreeDepthRow& row, int u, const SpaceLengths& lengths,
                        DepthUnits of_hole) {
  const auto fate = static_cast<PixelFate>(row.fate[u]);
  const bool is_empty = std::isnan(row.sensed_m[u]) && std::isnan(row.obstacle_m[u]);
  if (is_empty || frees(fate) == Frees::as_hole) return of_hole;
  const float back_m = row.environment_back_m ? row.environment_back_m[u] : kNoDepth;
  const float own_m = own_of_reading(row.sensed_m[u], row.obstacle_m[u], back_m, fate, lengths);
  return std::isnan(own_m) ? DepthUnits{0} : units_of(own_m);
}

}  // namespace

void find_own_free_depth(DepthView sensor_depth_m, const ObstacleImage& obstacles,
                         DepthView environment_back_m, const SpaceSettings& settings,
                         UnitImage& sensor_depth, DepthWindows& hidden, UnitImage& own) {
  // Below this width a row may not fit a whole vector of any instruction set.
  constexpr int kLeastWidth = 16;
  const int width = sensor_depth_m.width;
  const int height = sensor_depth_m.height;
  const SpaceLengths lengths{static_cast<float>(settings.free_space_margin_m),
                             static_cast<float>(settings.behind_robot_m),
                             static_cast<float>(settings.surface_thickness_m)};
  const DepthUnits of_hole = settings.no_reading == NoReading::free ? kEndlessUnits : 0;
  set_size(width, height, sensor_depth);
  set_size(width, height, own);
  DepthWindows::Level& hides = begin_depth_windows(width, height, hidden);
  for (int v = 0; v < height; ++v) {
    const FreeDepthRow row{sensor_depth_m.row(v), obstacles.depth_m.row(v),
                           reinterpret_cast<const std::uint8_t*>(obstacles.fate.row(v)),
                           environment_back_m.width > 0 ? environment_back_m.row(v) : nullptr};
    const UnitRow out{sensor_depth.row(v), hides.row(v), own.row(v)};
    if (width >= kLeastWidth) {
      HWY_DYNAMIC_DISPATCH(fill_own)(row, width, lengths, of_hole, out);
      continue;
    }
    for (int u = 0; u < width; ++u) {
      out.sensed[u] = units_of(row.sensed_m[u]);
      const bool is_flying = static_cast<PixelFate>(row.fate[u]) == PixelFate::flying_patch;
      out.hidden[u] =
          units_of(is_flying ? row.sensed_m[u] : row.obstacle_m[u] + lengths.thickness_m);
      out.own[u] = own_of_pixel(row, u, lengths, of_hole);
    }
  }
}

void find_free_depth(const UnitImage& own, DepthWindows& out) {
  const int width = own.width();
  const int height = own.height();
  DepthWindows::Level& image = begin_depth_windows(width, height, out);
  for (int v = 0; v < height; ++v) {
    DepthUnits* const row = image.row(v);
    if (v == 0 || v + 1 == height || width < 3) {
      std::fill_n(row, width, DepthUnits{0});
      continue;
    }
    HWY_DYNAMIC_DISPATCH(fill_least)(own.row(v - 1), own.row(v), own.row(v + 1), width, row);
    row[0] = row[width - 1] = 0;
  }
}

}  // namespace berth
#endif  // HWY_ONCE
