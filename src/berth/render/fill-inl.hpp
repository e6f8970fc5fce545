// Inside render/ only: from planned triangles to pixels, for the instruction set that the including
// file is being compiled for.
#if defined(BERTH_RENDER_FILL_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_RENDER_FILL_INL_HPP
#undef BERTH_RENDER_FILL_INL_HPP
#else
#define BERTH_RENDER_FILL_INL_HPP
#endif

#include <algorithm>
#include <bit>
#include <cmath>

#include "berth/render/project-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

using Ints = hn::RebindToSigned<FloatTag>;

/// A plane of each lane's own triangle at the lane's own pixel.
template <int size>
HWY_INLINE FloatVector plane_at(const float (&plane)[3][size], FloatVector du, FloatVector dv) {
  const FloatTag d;
  const auto at_row = hn::Add(hn::Load(d, plane[0]), hn::Mul(hn::Load(d, plane[2]), dv));
  return hn::Add(at_row, hn::Mul(hn::Load(d, plane[1]), du));
}

/// What of the triangles counts: all, or what lies behind the ceilings of the keys.
enum class Layer { first, behind };

/// Fills small triangles side by side: all lanes walk through their own rectangles, pixel by pixel.
template <Layer layer>
HWY_INLINE void fill_small(const TrianglePlanes& planes, LaneMask lanes, PixelKey id,
                           KeyImage& keys) {
  const FloatTag d;
  const Ints di;
  alignas(64) std::int32_t pixel[kLanes];
  alignas(64) float inverse_depth[kLanes];
  const auto last_du = hn::Load(d, planes.last_du);
  const auto last_dv = hn::Load(d, planes.last_dv);
  const auto first_pixel =
      hn::Add(hn::Mul(hn::ConvertTo(di, hn::Load(d, planes.v)), hn::Set(di, keys.width())),
              hn::ConvertTo(di, hn::Load(d, planes.u)));
  const auto width = hn::Set(d, static_cast<float>(keys.width()));
  auto du = hn::Zero(d);
  auto dv = hn::Zero(d);
  while (!hn::AllFalse(d, lanes)) {
    const auto nearest_edge =
        hn::Min(hn::Min(plane_at(planes.edge[0], du, dv), plane_at(planes.edge[1], du, dv)),
                plane_at(planes.edge[2], du, dv));
    std::uint32_t hits = bits_of(hn::And(lanes, hn::Ge(nearest_edge, hn::Zero(d))));
    if (hits != 0) {
      const auto depth = plane_at(planes.inverse_depth, du, dv);
      hn::Store(hn::Min(hn::Max(depth, hn::Load(d, planes.inverse_depth_lo)),
                        hn::Load(d, planes.inverse_depth_hi)),
                d, inverse_depth);
      const auto offset = hn::Add(hn::Mul(dv, width), du);
      hn::Store(hn::Add(first_pixel, hn::ConvertTo(di, offset)), di, pixel);
      for (; hits != 0; hits &= hits - 1) {
        const int i = std::countr_zero(hits);
        if (layer == Layer::behind && !(inverse_depth[i] < keys.ceilings()[pixel[i]])) continue;
        PixelKey& key = keys.data()[pixel[i]];
        key = std::max(key, make_key(inverse_depth[i], id));
      }
    }
    du = hn::Add(du, hn::Set(d, 1.0F));
    const auto row_ends = hn::Gt(du, last_du);
    du = hn::IfThenZeroElse(row_ends, du);
    dv = hn::Add(dv, hn::IfThenElseZero(row_ends, hn::Set(d, 1.0F)));
    lanes = hn::And(lanes, hn::Le(dv, last_dv));
  }
}

/// The vectors of RowFiller: as many floats as keys.
using Keys = hn::CappedTag<PixelKey, 8>;
using RowFloats = hn::Rebind<float, Keys>;
using RowInts = hn::Rebind<std::int32_t, Keys>;
constexpr int kRowLanes = static_cast<int>(hn::MaxLanes(Keys()));
static_assert(kRowLanes <= KeyImage::kPadding);

/// One triangle, a row of pixels at a time.
template <Layer layer>
class RowFiller {
 public:
  RowFiller(const TrianglePlanes& planes, int lane, PixelKey id)
      : id_(id),
        u_(static_cast<int>(planes.u[lane])),
        v_(static_cast<int>(planes.v[lane])),
        rows_(static_cast<int>(planes.last_dv[lane]) + 1),
        last_du_(planes.last_du[lane]),
        lo_(planes.inverse_depth_lo[lane]),
        hi_(planes.inverse_depth_hi[lane]) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) edge_[i][k] = planes.edge[i][k][lane];
      depth_[i] = planes.inverse_depth[i][lane];
    }
  }

  void fill(KeyImage& keys) const {
    for (int dv = 0; dv < rows_; ++dv) {
      fill_row(static_cast<float>(dv), keys, keys.place(u_, v_ + dv));
    }
  }

 private:
  /// The pixels of a long row that can be inside: an edge is met within a pixel of where it is
  /// computed.
  HWY_INLINE void shorten(const float (&edge_at_row)[3], float& first, float& last) const {
    for (int i = 0; i < 3; ++i) {
      const float slope = edge_[i][1];
      const float zero_at = -edge_at_row[i] / slope;
      if (slope > 0) first = std::max(first, std::floor(zero_at) - 1);
      if (slope < 0) last = std::min(last, std::ceil(zero_at) + 1);
    }
  }

  HWY_INLINE void fill_row(float dv, KeyImage& keys, std::ptrdiff_t first_pixel) const {
    float edge_at_row[3];
    for (int i = 0; i < 3; ++i) edge_at_row[i] = edge_[i][0] + edge_[i][2] * dv;
    float first = 0;
    float last = last_du_;
    if (last_du_ >= 2 * kRowLanes) shorten(edge_at_row, first, last);
    const float depth_at_row = depth_[0] + depth_[2] * dv;
    for (float du = first; du <= last; du += kRowLanes) {
      fill_vector(edge_at_row, depth_at_row, du, keys, first_pixel + static_cast<int>(du));
    }
  }

  HWY_INLINE void fill_vector(const float (&edge_at_row)[3], float depth_at_row, float first_du,
                              KeyImage& keys, std::ptrdiff_t pixel) const {
    const RowFloats d;
    const auto du = hn::Add(hn::Set(d, first_du), hn::Iota(d, 0.0F));
    const auto at = [&](float at_row, float slope) HWY_ATTR {
      return hn::Add(hn::Set(d, at_row), hn::Mul(hn::Set(d, slope), du));
    };
    const auto nearest_edge =
        hn::Min(hn::Min(at(edge_at_row[0], edge_[0][1]), at(edge_at_row[1], edge_[1][1])),
                at(edge_at_row[2], edge_[2][1]));
    auto inside = hn::And(hn::Ge(nearest_edge, hn::Zero(d)), hn::Le(du, hn::Set(d, last_du_)));
    if (hn::AllFalse(d, inside)) return;
    const auto depth =
        hn::Min(hn::Max(at(depth_at_row, depth_[1]), hn::Set(d, lo_)), hn::Set(d, hi_));
    if constexpr (layer == Layer::behind) {
      inside = hn::And(inside, hn::Lt(depth, hn::LoadU(d, keys.ceilings() + pixel)));
    }
    const auto bits = hn::BitCast(RowInts(), hn::IfThenElseZero(inside, depth));
    const Keys dk;
    const auto found = hn::Or(hn::ShiftLeft<32>(hn::PromoteTo(dk, bits)), hn::Set(dk, id_));
    PixelKey* const at_pixel = keys.data() + pixel;
    hn::StoreU(hn::Max(found, hn::LoadU(dk, at_pixel)), dk, at_pixel);
  }

  PixelKey id_;
  int u_;
  int v_;
  int rows_;
  float last_du_;
  float lo_;
  float hi_;
  float edge_[3][3];
  float depth_[3];
};

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
