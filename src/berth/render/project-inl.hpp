// Inside render/ only: from the link's frame to the image, for the instruction set that the
// including file is being compiled for.
#if defined(BERTH_RENDER_PROJECT_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_RENDER_PROJECT_INL_HPP
#undef BERTH_RENDER_PROJECT_INL_HPP
#else
#define BERTH_RENDER_PROJECT_INL_HPP
#endif

#include <cstdint>

#include "berth/render/draw_triangles.hpp"
#include "berth/render/set_bits.hpp"
#include "berth/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

static_assert(TriangleBlock::kTriangles % kLanes == 0);

HWY_INLINE FloatVector least(const FloatVector (&x)[3]) {
  return hn::Min(hn::Min(x[0], x[1]), x[2]);
}
HWY_INLINE FloatVector greatest(const FloatVector (&x)[3]) {
  return hn::Max(hn::Max(x[0], x[1]), x[2]);
}

/// LinkInImage in single precision.
struct Projection {
  float to_pixel_L[3][4];
  float u_first;
  float v_first;
  float u_last;
  float v_last;
  float least_depth_m;

  explicit Projection(const LinkInImage& view)
      : u_first(static_cast<float>(view.rect.u_begin)),
        v_first(static_cast<float>(view.rect.v_begin)),
        u_last(static_cast<float>(view.rect.u_end - 1)),
        v_last(static_cast<float>(view.rect.v_end - 1)),
        least_depth_m(static_cast<float>(view.single_precision_from_m)) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        to_pixel_L[row][column] = static_cast<float>(view.to_pixel_L(row, column));
      }
    }
  }
};

/// One vector of triangles in the image.
struct Projected {
  FloatVector u[3];
  FloatVector v[3];
  FloatVector z_m[3];
  FloatVector inverse_depth[3];
};

HWY_INLINE FloatVector transform(const float (&row)[4], FloatVector x, FloatVector y,
                                 FloatVector z) {
  const FloatTag d;
  return hn::Add(hn::Add(hn::Mul(hn::Set(d, row[0]), x), hn::Mul(hn::Set(d, row[1]), y)),
                 hn::Add(hn::Mul(hn::Set(d, row[2]), z), hn::Set(d, row[3])));
}

HWY_INLINE void project(const TriangleBlock& block, int lane, const Projection& p, Projected& out) {
  const FloatTag d;
  for (int corner = 0; corner < 3; ++corner) {
    const auto x = hn::Load(d, block.corner_L_m[corner][0] + lane);
    const auto y = hn::Load(d, block.corner_L_m[corner][1] + lane);
    const auto z = hn::Load(d, block.corner_L_m[corner][2] + lane);
    out.z_m[corner] = transform(p.to_pixel_L[2], x, y, z);
    out.inverse_depth[corner] = hn::Div(hn::Set(d, 1.0F), out.z_m[corner]);
    out.u[corner] = hn::Mul(transform(p.to_pixel_L[0], x, y, z), out.inverse_depth[corner]);
    out.v[corner] = hn::Mul(transform(p.to_pixel_L[1], x, y, z), out.inverse_depth[corner]);
  }
}

/// The whole numbers from `first` to `last` that lie within a triangle's coordinates.
struct Centres {
  FloatVector first;
  FloatVector last;
  FloatVector extent;

  HWY_INLINE Centres(const FloatVector (&x)[3], float first_of_all, float last_of_all) {
    const FloatTag d;
    const auto tolerance = hn::Set(d, kEdgeTolerance_px);
    const auto low = least(x);
    const auto high = greatest(x);
    extent = hn::Sub(high, low);
    first = hn::Max(hn::Ceil(hn::Sub(low, tolerance)), hn::Set(d, first_of_all));
    last = hn::Min(hn::Floor(hn::Add(high, tolerance)), hn::Set(d, last_of_all));
  }
};

/// A larger triangle is too rare to be worth single precision's care.
constexpr float kLargest_px = 512;

/// The order in which the set lanes come first. Highway's Compress has it, but with AVX2 it would
/// look its table up for each vector anew.
HWY_INLINE auto set_lanes_first(LaneMask lanes) {
  const hn::RebindToUnsigned<FloatTag> d;
  if constexpr (kLanes > 8) {
    const auto places = hn::Compress(hn::Iota(d, 0), hn::RebindMask(d, lanes));
    return hn::IndicesFromVec(FloatTag(), places);
  } else {
    const hn::Rebind<std::uint8_t, FloatTag> bytes;
    const auto places = hn::LoadU(bytes, kSetBits.places[bits_of(lanes)]);
    return hn::IndicesFromVec(FloatTag(), hn::PromoteTo(d, places));
  }
}

template <class Order>
HWY_INLINE void append(FloatVector x, Order order, float* to) {
  hn::StoreU(hn::TableLookupLanes(x, order), FloatTag(), to);
}

/// Puts those of the block's triangles that may cover a pixel's centre into `out`. Returns the bits
/// of those that single precision cannot serve.
HWY_INLINE std::uint32_t project_block(const TriangleBlock& block, int lane, const Projection& p,
                                       ImageTriangles& out) {
  const FloatTag d;
  Projected t;
  project(block, lane, p, t);
  const Centres u(t.u, p.u_first, p.u_last);
  const Centres v(t.v, p.v_first, p.v_last);
  const auto covers = hn::And(hn::Le(u.first, u.last), hn::Le(v.first, v.last));
  const auto far = hn::Ge(least(t.z_m), hn::Set(d, p.least_depth_m));
  const auto small = hn::Le(hn::Max(u.extent, v.extent), hn::Set(d, kLargest_px));
  const auto hard = hn::Or(hn::Not(far), hn::And(covers, hn::Not(small)));
  const auto taken = hn::AndNot(hard, covers);
  if (!hn::AllFalse(d, taken)) {
    const auto order = set_lanes_first(taken);
    const int to = out.count;
    for (int corner = 0; corner < 3; ++corner) {
      append(t.u[corner], order, out.u[corner] + to);
      append(t.v[corner], order, out.v[corner] + to);
      append(t.inverse_depth[corner], order, out.inverse_depth[corner] + to);
    }
    append(u.first, order, out.first_u + to);
    append(v.first, order, out.first_v + to);
    append(hn::Sub(u.last, u.first), order, out.last_du + to);
    append(hn::Sub(v.last, v.first), order, out.last_dv + to);
    out.count += static_cast<int>(hn::CountTrue(d, taken));
  }
  return bits_of(hn::And(hard, hn::Gt(greatest(t.z_m), hn::Zero(d))));
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
