#include "berth/distance/mesh/hidden_blocks.hpp"

#include <algorithm>
#include <limits>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/mesh/hidden_blocks.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/mesh/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

using IntTag = hn::RebindToSigned<FloatTag>;
using Ints = hn::Vec<IntTag>;

/// A rectangle is looked up pixel by pixel up to this size, else in a window of at most twice it.
constexpr int kMostPixels = 4;
/// What rounding may do to a pixel's coordinate.
constexpr float kPixelError = 2e-3f;
/// A cube that reaches nearer to the camera's plane has no rectangle.
constexpr float kLeastDepth_m = 1e-4f;

/// Pixels u0 to u1 and v0 to v1, both included, inside the image.
struct Rects {
  Ints u0, v0, u1, v1;
  /// The most pixels beyond the first, in either direction.
  int span;
};

struct Extremes {
  Lanes least;
  Lanes greatest;
};

/// What the pixels of each rectangle hold; a NaN counts as +inf.
HWY_INLINE Extremes extremes_of(const DepthImage& image, const DepthWindows& windows,
                                const Rects& rects) {
  const IntTag ints;
  if (rects.span < kMostPixels) {
    Extremes all{Lanes(HUGE_VALF), Lanes(-HUGE_VALF)};
    for (int dv = 0; dv <= rects.span; ++dv) {
      const Ints row = hn::Mul(hn::Min(hn::Add(rects.v0, hn::Set(ints, dv)), rects.v1),
                               hn::Set(ints, image.width()));
      for (int du = 0; du <= rects.span; ++du) {
        const Ints column = hn::Min(hn::Add(rects.u0, hn::Set(ints, du)), rects.u1);
        const Lanes found =
            hn::GatherIndex(FloatTag(), image.pixels().data(), hn::Add(row, column));
        const Lanes x = select(hn::Eq(found.v, found.v), found, Lanes(HUGE_VALF));
        all.least = least(all.least, x);
        all.greatest = greatest(all.greatest, x);
      }
    }
    return all;
  }
  int n = 0;
  while (n + 1 < windows.level_count && windows.levels[n].step_px < rects.span) ++n;
  const DepthWindows::Level& level = windows.levels[n];
  const int shift = n + 2;
  const Ints place =
      hn::Add(hn::Mul(hn::ShiftRightSame(rects.v0, shift), hn::Set(ints, level.columns)),
              hn::ShiftRightSame(rects.u0, shift));
  return {hn::GatherIndex(FloatTag(), level.least.data(), place),
          hn::GatherIndex(FloatTag(), level.greatest.data(), place)};
}

/// What one view says of some cubes, a bit for each.
struct Sayings {
  std::uint32_t hides_some = 0;
  std::uint32_t hides_all = 0;
  std::uint32_t frees_all = 0;
  std::uint32_t frees_some = 0;
};

struct Interval {
  Lanes lo;
  Lanes hi;
};

/// x / z for all x in [x - dx, x + dx] and z in [za, zb], za > 0.
HWY_INLINE Interval slopes(Lanes x, float dx, Lanes inv_za, Lanes inv_zb) {
  const Lanes zero(0.0f);
  const Lanes lo = x - Lanes(dx);
  const Lanes hi = x + Lanes(dx);
  return {lo * select(lo >= zero, inv_zb, inv_za), hi * select(hi >= zero, inv_za, inv_zb)};
}

/// The least and greatest of pixels that an interval of slopes covers, as floats.
HWY_INLINE Interval pixels_of(const Interval& slope, double focal_px, double centre_px) {
  const Lanes f(static_cast<float>(focal_px));
  const Lanes c(static_cast<float>(centre_px + 0.5));
  constexpr float kFar_px = 1e6f;
  const Lanes lo = clamp(slope.lo * f + c, Lanes(-kFar_px), Lanes(kFar_px));
  const Lanes hi = clamp(slope.hi * f + c, Lanes(-kFar_px), Lanes(kFar_px));
  return {hn::Floor((lo - Lanes(kPixelError)).v), hn::Floor((hi + Lanes(kPixelError)).v)};
}

/// The centres of some cubes in B.
struct Centres {
  Lanes x, y, z;
};

HWY_INLINE Sayings say(const CarvingView& view, const Centres& p_B, float reach_m, float half_m) {
  const ViewSpace& space = *view.space;
  Sayings sayings;
  if (space.is_empty()) return sayings;
  const Eigen::Matrix3f R = view.X_CB.linear().cast<float>();
  const Eigen::Vector3f t = view.X_CB.translation().cast<float>();
  // Four roundings of numbers up to the sum of both lengths.
  const float error_m = 8 * std::numeric_limits<float>::epsilon() * (reach_m + t.norm());
  const Eigen::Vector3f half = half_m * R.cwiseAbs().rowwise().sum().array() + error_m;
  const auto row = [&](int i) {
    return mul_add(Lanes(R(i, 0)), p_B.x,
                   mul_add(Lanes(R(i, 1)), p_B.y, mul_add(Lanes(R(i, 2)), p_B.z, Lanes(t[i]))));
  };
  const Lanes z = row(2);
  const Lanes za = z - Lanes(half.z());
  const Lanes zb = z + Lanes(half.z());
  const Lanes slab(static_cast<float>(space.settings.slab_m));
  const Mask is_behind_camera = zb <= Lanes(0.0f);
  const Mask is_before = za >= Lanes(kLeastDepth_m);
  // What reaches through the camera's plane may be seen by any pixel.
  const std::uint32_t through = bits_of(hn::Not(hn::Or(is_behind_camera, is_before)));
  if (through != 0) {
    const float least_m =
        space.obstacle_windows.levels[space.obstacle_windows.level_count - 1].least[0];
    sayings.hides_some = through & bits_of(zb > Lanes(least_m) + slab);
    if (view.free_depth_m != nullptr) sayings.frees_some = through;
  }
  const Lanes inv_za = Lanes(1.0f) / greatest(za, Lanes(kLeastDepth_m));
  const Lanes inv_zb = Lanes(1.0f) / greatest(zb, Lanes(kLeastDepth_m));
  const Camera& camera = space.camera;
  const Interval u =
      pixels_of(slopes(row(0), half.x(), inv_za, inv_zb), camera.fx_px, camera.cx_px);
  const Interval v =
      pixels_of(slopes(row(1), half.y(), inv_za, inv_zb), camera.fy_px, camera.cy_px);
  const Lanes zero(0.0f);
  const Lanes last_u(static_cast<float>(camera.width_px - 1));
  const Lanes last_v(static_cast<float>(camera.height_px - 1));
  const Mask meets =
      both(is_before, both(both(u.hi >= zero, u.lo <= last_u), both(v.hi >= zero, v.lo <= last_v)));
  const Mask inside =
      both(meets, both(both(u.lo >= zero, u.hi <= last_u), both(v.lo >= zero, v.hi <= last_v)));
  if (bits_of(meets) == 0) return sayings;
  const Lanes u0 = clamp(u.lo, zero, last_u);
  const Lanes v0 = clamp(v.lo, zero, last_v);
  const Lanes u1 = clamp(u.hi, zero, last_u);
  const Lanes v1 = clamp(v.hi, zero, last_v);
  const IntTag ints;
  const float span = greatest_lane(select(meets, greatest(u1 - u0, v1 - v0), zero));
  const Rects rects{hn::ConvertTo(ints, u0.v), hn::ConvertTo(ints, v0.v), hn::ConvertTo(ints, u1.v),
                    hn::ConvertTo(ints, v1.v), static_cast<int>(span)};
  const Extremes depth = extremes_of(space.obstacle_depth_m, space.obstacle_windows, rects);
  sayings.hides_some |= bits_of(both(meets, zb > depth.least + slab));
  sayings.hides_all = bits_of(both(inside, za > depth.greatest + slab));
  if (view.free_depth_m == nullptr) return sayings;
  const Extremes free = extremes_of(*view.free_depth_m, *view.free_windows, rects);
  sayings.frees_all = bits_of(both(inside, zb < free.least));
  sayings.frees_some |= bits_of(both(meets, za < free.greatest));
  return sayings;
}

CubeBlock find(std::span<const CarvingView> views, const Cube& cube) {
  const auto edge_m = static_cast<float>(cube.edge_m() / 4);
  const Eigen::Vector3f corner = cube.corner_m().cast<float>();
  const float reach_m = corner.norm() + 4 * edge_m;
  Sayings sayings[HiddenSpace::kMostViews];
  const std::uint32_t all_lanes = (1u << kLanes) - 1;
  CubeBlock block;
  for (int i = 0; i < 64; i += kLanes) {
    alignas(64) float column[kLanes];
    alignas(64) float row[kLanes];
    alignas(64) float layer[kLanes];
    for (int k = 0; k < kLanes; ++k) {
      column[k] = static_cast<float>((i + k) & 3) + 0.5f;
      row[k] = static_cast<float>((i + k) >> 2 & 3) + 0.5f;
      layer[k] = static_cast<float>((i + k) >> 4) + 0.5f;
    }
    const Lanes edge(edge_m);
    const Centres centres{mul_add(edge, load(column), Lanes(corner.x())),
                          mul_add(edge, load(row), Lanes(corner.y())),
                          mul_add(edge, load(layer), Lanes(corner.z()))};
    std::uint32_t freed_all_once = 0, freed_all_twice = 0;
    std::uint32_t freed_some_once = 0, freed_some_twice = 0;
    for (std::size_t k = 0; k < views.size(); ++k) {
      sayings[k] = say(views[k], centres, reach_m, 0.5f * edge_m);
      freed_all_twice |= freed_all_once & sayings[k].frees_all;
      freed_all_once |= sayings[k].frees_all;
      freed_some_twice |= freed_some_once & sayings[k].frees_some;
      freed_some_once |= sayings[k].frees_some;
    }
    std::uint32_t possible = 0, full = 0;
    for (std::size_t k = 0; k < views.size(); ++k) {
      // What another view than k frees: all that two do, or one that is not k.
      const std::uint32_t all = freed_all_twice | (freed_all_once & ~sayings[k].frees_all);
      const std::uint32_t some = freed_some_twice | (freed_some_once & ~sayings[k].frees_some);
      possible |= sayings[k].hides_some & ~all;
      full |= sayings[k].hides_all & ~some;
    }
    block.possible |= static_cast<std::uint64_t>(possible & all_lanes) << i;
    block.full |= static_cast<std::uint64_t>(full & all_lanes) << i;
  }
  return block;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth::mesh {

HWY_EXPORT(find);

CubeBlock find_block(std::span<const CarvingView> views, const Cube& cube) {
  return HWY_DYNAMIC_DISPATCH(find)(views, cube);
}

}  // namespace berth::mesh
#endif  // HWY_ONCE
