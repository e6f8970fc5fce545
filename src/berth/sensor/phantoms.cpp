#include "berth/sensor/phantoms.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#ifndef BERTH_PHANTOM_SUPPORT
#define BERTH_PHANTOM_SUPPORT
namespace berth {
/// Three rows of the filtered image, the middle one's number and how long they are.
struct PhantomRows {
  const float* row_m[3];
  int v;
  int width;
};

/// One row of what came and what was kept, and the part of it beside a reading.
struct SupportRow {
  const float* kept_m;
  const float* sensed_m;
  const std::uint8_t* fate;
  int width;
  int begin;
  int end;
};
}  // namespace berth
#endif

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/sensor/phantoms.cpp"
#include "hwy/foreach_target.h"

#include "berth/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// Of the pixels from u on, those that may be alone, as bits: kept ones that are not within d in
/// depth of enough of their eight neighbours, so that no search is needed.
template <class D>
HWY_INLINE std::uint64_t doubtful_bits(D d, const PhantomRows& rows, int u, float d_m) {
  const auto z_m = hn::LoadU(d, rows.row_m[1] + u);
  const auto step_m = hn::Mul(hn::Mul(z_m, z_m), hn::Set(d, static_cast<float>(kDepthStep_per_m)));
  const auto within_m = hn::Max(hn::Set(d, d_m), step_m);
  auto found = hn::Zero(d);
  for (const float* row_m : rows.row_m) {
    for (int aside = -1; aside <= 1; ++aside) {
      const auto off_m = hn::Abs(hn::Sub(hn::LoadU(d, row_m + u + aside), z_m));
      found = hn::Add(found, hn::IfThenElseZero(hn::Le(off_m, within_m), hn::Set(d, 1.0F)));
    }
  }
  const auto is_alone = hn::Lt(found, hn::Set(d, static_cast<float>(kMostSupport)));
  return bits_of(d, hn::And(is_alone, hn::Eq(z_m, z_m)));
}

void append_doubtful(const PhantomRows& rows, float d_m, std::vector<Pixel>& out) {
  const auto append = [&](int first, std::uint64_t bits) {
    for (; bits != 0; bits &= bits - 1) out.push_back({first + std::countr_zero(bits), rows.v});
  };
  int u = 1;
  for (; u + kLanes < rows.width; u += kLanes) append(u, doubtful_bits(FloatTag(), rows, u, d_m));
  for (; u + 1 < rows.width; ++u) append(u, doubtful_bits(OneFloatTag(), rows, u, d_m));
}

template <class D>
HWY_INLINE hn::Mask<D> supports(D d, const SupportRow& row, int u, float z_m, float within_m) {
  const auto is_near = [&](const float* depth_m) {
    const auto off_m = hn::Abs(hn::Sub(hn::LoadU(d, depth_m + u), hn::Set(d, z_m)));
    return hn::Le(off_m, hn::Set(d, within_m));
  };
  const hn::Rebind<std::int32_t, D> whole;
  const auto fate = hn::PromoteTo(whole, hn::LoadU(hn::Rebind<std::uint8_t, D>(), row.fate + u));
  const auto has_fate = [&](PixelFate of) {
    return hn::RebindMask(d, hn::Eq(fate, hn::Set(whole, static_cast<int>(of))));
  };
  return hn::AndNot(hn::Or(has_fate(PixelFate::robot), has_fate(PixelFate::environment)),
                    hn::Or(is_near(row.kept_m), is_near(row.sensed_m)));
}

/// How many pixels of the row's part may be of the thing that a reading at z shows.
int count_support(const SupportRow& row, float z_m, float within_m) {
  std::size_t found = 0;
  int u = row.begin;
  for (; u < row.end && u + kLanes <= row.width; u += kLanes) {
    const auto in_part = hn::FirstN(FloatTag(), static_cast<std::size_t>(row.end - u));
    found += hn::CountTrue(FloatTag(), both(in_part, supports(FloatTag(), row, u, z_m, within_m)));
  }
  for (; u < row.end; ++u) {
    found += hn::CountTrue(OneFloatTag(), supports(OneFloatTag(), row, u, z_m, within_m));
  }
  return static_cast<int>(found);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(append_doubtful);
HWY_EXPORT(count_support);

namespace {

/// Of the pixels that a ball covers.
constexpr double kLeastShare = 0.25;

/// Kept readings that may be alone. All at the image's border may.
void find_doubtful(const DepthImage& depth_m, float d_m, std::vector<Pixel>& out) {
  const int width = depth_m.width(), height = depth_m.height();
  const auto append = [&](int u, int v) {
    if (!std::isnan(depth_m(u, v))) out.push_back({u, v});
  };
  out.clear();
  for (int v = 0; v < height; ++v) {
    if (v == 0 || v + 1 == height) {
      for (int u = 0; u < width; ++u) append(u, v);
      continue;
    }
    append(0, v);
    if (width > 1) append(width - 1, v);
    const PhantomRows rows{{depth_m.row(v - 1), depth_m.row(v), depth_m.row(v + 1)}, v, width};
    HWY_DYNAMIC_DISPATCH(append_doubtful)(rows, d_m, out);
  }
}

/// Whether `wanted` readings, itself among them, lie within d. Most stand in the nearest rows.
bool has_support(DepthView sensor_depth_m, const ObstacleImage& image, Pixel p, int reach_px,
                 float d_m, int wanted) {
  const int width = sensor_depth_m.width;
  const float z_m = image.depth_m(p.u, p.v);
  const float within_m = std::max(d_m, z_m * z_m * static_cast<float>(kDepthStep_per_m));
  const int begin = std::max(p.u - reach_px, 0), end = std::min(p.u + reach_px + 1, width);
  int found = 0;
  const auto count = [&](int v) {
    if (v < 0 || v >= sensor_depth_m.height || found >= wanted) return;
    const SupportRow row{image.depth_m.row(v),
                         sensor_depth_m.row(v),
                         reinterpret_cast<const std::uint8_t*>(image.fate.row(v)),
                         width,
                         begin,
                         end};
    found += HWY_DYNAMIC_DISPATCH(count_support)(row, z_m, within_m);
  };
  count(p.v);
  for (int aside = 1; aside <= reach_px && found < wanted; ++aside) {
    count(p.v - aside);
    count(p.v + aside);
  }
  return found >= wanted;
}

}  // namespace

int support_of_phantom_rule(const Camera& camera, double phantom_radius_m, float depth_m) {
  const double across_px2 = camera.fx_px * camera.fy_px * phantom_radius_m * phantom_radius_m /
                            (double{depth_m} * depth_m);
  return static_cast<int>(
      std::clamp(kLeastShare * std::numbers::pi / 4 * across_px2, 1.0, 1.0 * kMostSupport));
}

void drop_phantoms(const Camera& camera, DepthView sensor_depth_m, double phantom_radius_m,
                   PhantomWorkspace& workspace, ObstacleImage& out) {
  if (!(phantom_radius_m > 0)) return;
  const auto d_m = static_cast<float>(phantom_radius_m);
  const double f_px = std::min(camera.fx_px, camera.fy_px);
  std::vector<Pixel>& lonely = workspace.lonely;
  find_doubtful(out.depth_m, d_m, lonely);
  std::erase_if(lonely, [&](const Pixel& p) {
    const PixelFate fate = out.fate(p.u, p.v);
    if (fate != PixelFate::obstacle) return true;
    const float z_m = out.depth_m(p.u, p.v);
    const int wanted = support_of_phantom_rule(camera, phantom_radius_m, z_m);
    const int reach_px =
        static_cast<int>(std::min(f_px * phantom_radius_m / z_m, 1.0 * kMostSupportReach_px));
    return has_support(sensor_depth_m, out, p, reach_px, d_m, wanted);
  });
  for (const Pixel& p : lonely) {
    --out.count[static_cast<std::size_t>(out.fate(p.u, p.v))];
    ++out.count[static_cast<std::size_t>(PixelFate::speckle)];
    out.fate(p.u, p.v) = PixelFate::speckle;
    out.depth_m(p.u, p.v) = kNoDepth;
  }
}

}  // namespace berth
#endif  // HWY_ONCE
