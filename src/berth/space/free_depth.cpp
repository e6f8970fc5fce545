#include "berth/space/free_depth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

constexpr float kMostDepth_m = std::numeric_limits<float>::max();
using FateTag = hn::Rebind<std::uint8_t, FloatTag>;
using WholeTag = hn::Rebind<std::int32_t, FloatTag>;

HWY_INLINE LaneMask is_nan(Lanes x) { return hn::Not(hn::Eq(x.v, x.v)); }

/// What kLanes pixels say.
struct FreeDepthPixels {
  Lanes sensed_m;
  Lanes obstacle_m;
  hn::Vec<WholeTag> fate;
  /// 0 where it is not known.
  Lanes environment_back_m;

  HWY_INLINE FreeDepthPixels(const FreeDepthRow& row, int u)
      : sensed_m(load(row.sensed_m + u)),
        obstacle_m(load(row.obstacle_m + u)),
        fate(hn::PromoteTo(WholeTag(), hn::LoadU(FateTag(), row.fate + u))),
        environment_back_m(0.0f) {
    if (row.environment_back_m == nullptr) return;
    const Lanes back_m = load(row.environment_back_m + u);
    environment_back_m = hn::IfThenZeroElse(is_nan(back_m), back_m.v);
  }

  /// Whether the fate is one of these and those between them.
  HWY_INLINE LaneMask is_within(PixelFate first, PixelFate last) const {
    const WholeTag d;
    const auto before = hn::Set(d, static_cast<int>(first) - 1);
    const auto after = hn::Set(d, static_cast<int>(last) + 1);
    return hn::RebindMask(FloatTag(), hn::And(hn::Gt(fate, before), hn::Gt(after, fate)));
  }
  HWY_INLINE LaneMask is_robot() const { return is_within(PixelFate::robot, PixelFate::dilation); }
  HWY_INLINE Lanes of_environment_m(float margin_m, Lanes most_m) const {
    return greater_or_first(sensed_m - Lanes(margin_m), least(most_m, environment_back_m));
  }
  HWY_INLINE LaneMask is_dropped() const {
    static_assert(static_cast<int>(PixelFate::dilation) + 1 == static_cast<int>(PixelFate::edge));
    return is_within(PixelFate::edge, PixelFate::speckle);
  }
  HWY_INLINE LaneMask is_hole() const { return hn::And(is_nan(sensed_m), is_nan(obstacle_m)); }
};

/// own_of_reading() of many pixels, and 0 where that is less or NaN; `of_hole_m` where there is
/// neither a reading nor an obstacle.
void fill_own(const FreeDepthRow& row, int width, float margin_m, float behind_m, float of_hole_m,
              float* own_m) {
  for_row(
      0, width,
      [&](int u) {
        const FreeDepthPixels pixels(row, u);
        const Lanes robot_m = pixels.sensed_m + Lanes(behind_m);
        const Lanes before_m = pixels.obstacle_m - Lanes(margin_m);
        const Lanes background_m =
            hn::IfThenZeroElse(is_nan(pixels.sensed_m), lesser_or_first(before_m, robot_m).v);
        auto own = hn::IfThenElse(pixels.is_within(PixelFate::background, PixelFate::background),
                                  background_m.v, before_m.v);
        own = hn::IfThenElse(pixels.is_robot(), robot_m.v, own);
        own = hn::IfThenElse(pixels.is_within(PixelFate::environment, PixelFate::environment),
                             pixels.of_environment_m(margin_m, robot_m).v, own);
        own = hn::IfThenElse(pixels.is_dropped(), (pixels.sensed_m - Lanes(margin_m)).v, own);
        own = hn::IfThenElseZero(hn::Gt(own, hn::Zero(FloatTag())), own);
        store(hn::IfThenElse(pixels.is_hole(), Lanes(of_hole_m).v, own), own_m + u);
      },
      [](int) {});
}

/// The least of 3 x 3 pixels in the columns [1, width - 1).
void fill_least(const float* above, const float* middle, const float* below, int width,
                float* out) {
  const auto of_column = [&](int u) {
    return least(least(load(above + u), load(middle + u)), load(below + u));
  };
  for_row(
      1, width - 1,
      [&](int u) {
        const Lanes all = least(least(of_column(u - 1), of_column(u)), of_column(u + 1));
        store(least(all, Lanes(kMostDepth_m)), out + u);
      },
      [&](int u) {
        float all = kMostDepth_m;
        for (const float* row : {above, middle, below}) {
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

constexpr float kEndless_m = std::numeric_limits<float>::max();

bool is_empty(float sensed_m, float obstacle_m) {
  return std::isnan(sensed_m) && std::isnan(obstacle_m);
}

float own_of_reading(float sensed_m, float obstacle_m, float environment_back_m, PixelFate fate,
                     float margin_m, float behind_m) {
  switch (fate) {
    case PixelFate::background:
      return std::isnan(sensed_m) ? 0 : std::min(obstacle_m - margin_m, sensed_m + behind_m);
    case PixelFate::environment: {
      const float back_m = std::isnan(environment_back_m) ? 0 : environment_back_m;
      return std::max(sensed_m - margin_m, std::min(sensed_m + behind_m, back_m));
    }
    case PixelFate::robot:
    case PixelFate::padding:
    case PixelFate::dilation:
      return sensed_m + behind_m;
    case PixelFate::edge:
    case PixelFate::flying_patch:
    case PixelFate::outside_region:
    case PixelFate::soft:
    case PixelFate::speckle:
      return sensed_m - margin_m;
    case PixelFate::obstacle:
    case PixelFate::no_reading:
    case PixelFate::averaged:
    case PixelFate::hole:
      break;
  }
  return obstacle_m - margin_m;
}

float own_of_pixel(DepthView sensor_depth_m, const ObstacleImage& obstacles,
                   DepthView environment_back_m, const SpaceSettings& settings, int u, int v) {
  const auto margin_m = static_cast<float>(settings.free_space_margin_m);
  const auto behind_m = static_cast<float>(settings.behind_robot_m);
  const float sensed_m = sensor_depth_m(u, v);
  const float obstacle_m = obstacles.depth_m(u, v);
  if (is_empty(sensed_m, obstacle_m)) {
    return settings.no_reading == NoReading::free ? kEndless_m : 0;
  }
  const float back_m = environment_back_m.width > 0 ? environment_back_m(u, v) : kNoDepth;
  const float own_m =
      own_of_reading(sensed_m, obstacle_m, back_m, obstacles.fate(u, v), margin_m, behind_m);
  return own_m > 0 ? own_m : 0;
}

}  // namespace

void find_own_free_depth(DepthView sensor_depth_m, const ObstacleImage& obstacles,
                         DepthView environment_back_m, const SpaceSettings& settings,
                         DepthImage& out) {
  // Below this width a row may not fit a whole vector of any instruction set.
  constexpr int kLeastWidth = 16;
  const int width = sensor_depth_m.width;
  const int height = sensor_depth_m.height;
  const auto margin_m = static_cast<float>(settings.free_space_margin_m);
  const auto behind_m = static_cast<float>(settings.behind_robot_m);
  const float of_hole_m = settings.no_reading == NoReading::free ? kEndless_m : 0;
  if (out.width() != width || out.height() != height) out.resize(width, height, 0);
  for (int v = 0; v < height; ++v) {
    if (width < kLeastWidth) {
      for (int u = 0; u < width; ++u) {
        out(u, v) = own_of_pixel(sensor_depth_m, obstacles, environment_back_m, settings, u, v);
      }
      continue;
    }
    const FreeDepthRow row{sensor_depth_m.row(v), obstacles.depth_m.row(v),
                           reinterpret_cast<const std::uint8_t*>(obstacles.fate.row(v)),
                           environment_back_m.width > 0 ? environment_back_m.row(v) : nullptr};
    HWY_DYNAMIC_DISPATCH(fill_own)(row, width, margin_m, behind_m, of_hole_m, out.row(v));
  }
}

void find_free_depth(const DepthImage& own_m, DepthImage& out) {
  const int width = own_m.width();
  const int height = own_m.height();
  if (out.width() != width || out.height() != height) out.resize(width, height, 0);
  for (int v = 0; v < height; ++v) {
    float* const row = out.row(v);
    if (v == 0 || v + 1 == height || width < 3) {
      std::fill_n(row, width, 0.0f);
      continue;
    }
    HWY_DYNAMIC_DISPATCH(fill_least)
    (own_m.row(v - 1), own_m.row(v), own_m.row(v + 1), width, row);
    row[0] = row[width - 1] = 0;
  }
}

}  // namespace berth
#endif  // HWY_ONCE
