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

  HWY_INLINE FreeDepthPixels(const FreeDepthRow& row, int u)
      : sensed_m(load(row.sensed_m + u)),
        obstacle_m(load(row.obstacle_m + u)),
        fate(hn::PromoteTo(WholeTag(), hn::LoadU(FateTag(), row.fate + u))) {}

  /// Whether the fate is one of these and those between them.
  HWY_INLINE LaneMask is_within(PixelFate first, PixelFate last) const {
    const WholeTag d;
    const auto before = hn::Set(d, static_cast<int>(first) - 1);
    const auto after = hn::Set(d, static_cast<int>(last) + 1);
    return hn::RebindMask(FloatTag(), hn::And(hn::Gt(fate, before), hn::Gt(after, fate)));
  }
  HWY_INLINE LaneMask is_robot() const { return is_within(PixelFate::robot, PixelFate::dilation); }
  HWY_INLINE LaneMask is_dropped() const {
    static_assert(static_cast<int>(PixelFate::dilation) + 1 == static_cast<int>(PixelFate::edge));
    return is_within(PixelFate::edge, PixelFate::speckle);
  }
  HWY_INLINE LaneMask is_hole() const { return hn::And(is_nan(sensed_m), is_nan(obstacle_m)); }
};

/// own_of_reading() of many pixels, and 0 where that is less or NaN; `of_hole_m` where there is
/// neither a reading nor an obstacle. Returns whether there is such a pixel.
bool fill_own(const FreeDepthRow& row, int width, float margin_m, float behind_m, float of_hole_m,
              float* own_m) {
  Lanes holes(0.0f);
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
        own = hn::IfThenElse(pixels.is_dropped(), (pixels.sensed_m - Lanes(margin_m)).v, own);
        own = hn::IfThenElseZero(hn::Gt(own, hn::Zero(FloatTag())), own);
        const LaneMask is_hole = pixels.is_hole();
        holes = hn::IfThenElse(is_hole, Lanes(1.0f).v, holes.v);
        store(hn::IfThenElse(is_hole, Lanes(of_hole_m).v, own), own_m + u);
      },
      [](int) {});
  return greatest_lane(holes) > 0;
}

/// FreeDepthPixels without a reading, from the eight around them, which lie in the image.
HWY_INLINE void fill_holes_at(const FreeDepthRow* rows, int first, int last, int u,
                              float* const* own_m) {
  constexpr float kLeastNeighbours = 5;
  const FloatTag d;
  const LaneMask is_hole = FreeDepthPixels(rows[1], u).is_hole();
  if (hn::AllFalse(d, is_hole)) return;
  Lanes readings(0.0f);
  for (int y = first; y <= last; ++y) {
    for (int x = u - 1; x <= u + 1; ++x) {
      const LaneMask is_none = is_nan(load(rows[y].sensed_m + x));
      readings = readings + Lanes(hn::IfThenZeroElse(is_none, Lanes(1.0f).v));
    }
  }
  const LaneMask is_filled = hn::And(is_hole, hn::Ge(readings.v, Lanes(kLeastNeighbours).v));
  if (hn::AllFalse(d, is_filled)) return;
  Lanes least_m(kMostDepth_m);
  for (int y = first; y <= last; ++y) {
    for (int x = u - 1; x <= u + 1; ++x) {
      const FreeDepthPixels pixels(rows[y], x);
      // NaN is nothing to take the least of: without an obstacle those say nothing whose own free
      // depth is the obstacle's.
      const LaneMask says = hn::Or(hn::Not(is_nan(pixels.obstacle_m)),
                                   hn::Or(pixels.is_robot(), pixels.is_dropped()));
      const LaneMask counts = hn::And(says, hn::Not(is_nan(pixels.sensed_m)));
      least_m = least(least_m, hn::IfThenElse(counts, load(own_m[y] + x).v, least_m.v));
    }
  }
  float* const out = own_m[1] + u;
  store(hn::IfThenElse(is_filled, least_m.v, load(out).v), out);
}

/// The columns [1, width - 1) of the row in the middle of three; `first` and `last` are those of
/// the three that the image has.
void fill_holes(const FreeDepthRow* rows, int first, int last, int width, float* const* own_m) {
  for_row(
      1, width - 1, [&](int u) { fill_holes_at(rows, first, last, u, own_m); }, [](int) {});
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
HWY_EXPORT(fill_holes);
HWY_EXPORT(fill_least);

namespace {

constexpr float kEndless_m = std::numeric_limits<float>::max();

bool is_empty(float sensed_m, float obstacle_m) {
  return std::isnan(sensed_m) && std::isnan(obstacle_m);
}

float own_of_reading(float sensed_m, float obstacle_m, PixelFate fate, float margin_m,
                     float behind_m) {
  switch (fate) {
    case PixelFate::background:
      return std::isnan(sensed_m) ? 0 : std::min(obstacle_m - margin_m, sensed_m + behind_m);
    case PixelFate::robot:
    case PixelFate::environment:
    case PixelFate::padding:
    case PixelFate::dilation:
      return sensed_m + behind_m;
    case PixelFate::edge:
    case PixelFate::flying_patch:
    case PixelFate::speckle:
    case PixelFate::outside_region:
      return sensed_m - margin_m;
    case PixelFate::obstacle:
    case PixelFate::no_reading:
    case PixelFate::averaged:
    case PixelFate::hole:
      break;
  }
  return obstacle_m - margin_m;
}

float own_of_hole(DepthView sensor_depth_m, const ObstacleImage& obstacles, int u, int v,
                  float margin_m, float behind_m) {
  constexpr int kLeastNeighbours = 5;
  int readings = 0;
  float least_m = kEndless_m;
  const PixelRect around =
      clip({u - 1, v - 1, u + 2, v + 2}, sensor_depth_m.width, sensor_depth_m.height);
  for (int y = around.v_begin; y < around.v_end; ++y) {
    for (int x = around.u_begin; x < around.u_end; ++x) {
      const float sensed_m = sensor_depth_m(x, y);
      if (std::isnan(sensed_m)) continue;
      ++readings;
      least_m = std::min(least_m, own_of_reading(sensed_m, obstacles.depth_m(x, y),
                                                 obstacles.fate(x, y), margin_m, behind_m));
    }
  }
  return readings >= kLeastNeighbours ? least_m : 0;
}

float own_of_pixel(DepthView sensor_depth_m, const ObstacleImage& obstacles,
                   const SpaceSettings& settings, int u, int v) {
  const auto margin_m = static_cast<float>(settings.free_space_margin_m);
  const auto behind_m = static_cast<float>(settings.behind_robot_m);
  const float sensed_m = sensor_depth_m(u, v);
  const float obstacle_m = obstacles.depth_m(u, v);
  float own_m;
  if (!is_empty(sensed_m, obstacle_m)) {
    own_m = own_of_reading(sensed_m, obstacle_m, obstacles.fate(u, v), margin_m, behind_m);
  } else if (settings.no_reading == NoReading::free) {
    own_m = kEndless_m;
  } else {
    own_m = own_of_hole(sensor_depth_m, obstacles, u, v, margin_m, behind_m);
  }
  return own_m > 0 ? own_m : 0;
}

/// The three rows around one.
struct ThreeRows {
  FreeDepthRow rows[3];
  float* own_m[3];
  int first;
  int last;

  ThreeRows(DepthView sensor_depth_m, const ObstacleImage& obstacles, DepthImage& own, int v)
      : first(v > 0 ? 0 : 1), last(v + 1 < own.height() ? 2 : 1) {
    for (int y = first; y <= last; ++y) {
      const int at = v - 1 + y;
      rows[y] = {sensor_depth_m.row(at), obstacles.depth_m.row(at),
                 reinterpret_cast<const std::uint8_t*>(obstacles.fate.row(at))};
      own_m[y] = own.row(at);
    }
  }
};

}  // namespace

void find_own_free_depth(DepthView sensor_depth_m, const ObstacleImage& obstacles,
                         const SpaceSettings& settings, DepthImage& out) {
  // The least width at which all of a row but its ends fits whole vectors of any instruction set.
  constexpr int kLeastWidth = 18;
  const int width = sensor_depth_m.width;
  const int height = sensor_depth_m.height;
  const auto margin_m = static_cast<float>(settings.free_space_margin_m);
  const auto behind_m = static_cast<float>(settings.behind_robot_m);
  const bool is_free = settings.no_reading == NoReading::free;
  if (out.width() != width || out.height() != height) out.resize(width, height, 0);
  const auto one_by_one = [&](int u_begin, int u_end, int v) {
    for (int u = u_begin; u < u_end; ++u) {
      out(u, v) = own_of_pixel(sensor_depth_m, obstacles, settings, u, v);
    }
  };
  const auto fill_holes_of = [&](int v) {
    ThreeRows around(sensor_depth_m, obstacles, out, v);
    HWY_DYNAMIC_DISPATCH(fill_holes)
    (around.rows, around.first, around.last, width, around.own_m);
    one_by_one(0, 1, v);
    one_by_one(width - 1, width, v);
  };
  // Each row's holes once the row below is done.
  bool above_has_holes = false;
  for (int v = 0; v < height; ++v) {
    if (width < kLeastWidth) {
      one_by_one(0, width, v);
      continue;
    }
    const ThreeRows around(sensor_depth_m, obstacles, out, v);
    const bool has_holes = HWY_DYNAMIC_DISPATCH(fill_own)(around.rows[1], width, margin_m, behind_m,
                                                          is_free ? kEndless_m : 0, out.row(v));
    if (above_has_holes) fill_holes_of(v - 1);
    above_has_holes = has_holes && !is_free;
  }
  if (above_has_holes) fill_holes_of(height - 1);
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
