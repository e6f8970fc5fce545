// Inside render/ only: the planes of small triangles, for the instruction set that the including
// file is being compiled for.
#if defined(BERTH_RENDER_PLAN_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_RENDER_PLAN_INL_HPP
#undef BERTH_RENDER_PLAN_INL_HPP
#else
#define BERTH_RENDER_PLAN_INL_HPP
#endif

#include "berth/render/project-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// The corners as seen from the triangle's first pixel.
struct Corners {
  FloatVector x[3];
  FloatVector y[3];
  FloatVector inverse_depth[3];
  /// Twice the area; its sign is the winding.
  FloatVector area;
};

HWY_INLINE FloatVector cross(FloatVector ax, FloatVector ay, FloatVector bx, FloatVector by) {
  return hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
}

HWY_INLINE void load_corners(const ImageTriangles& t, int first, Corners& out) {
  const FloatTag d;
  for (int i = 0; i < 3; ++i) {
    out.x[i] = hn::Sub(hn::LoadU(d, t.u[i] + first), hn::LoadU(d, t.first_u + first));
    out.y[i] = hn::Sub(hn::LoadU(d, t.v[i] + first), hn::LoadU(d, t.first_v + first));
    out.inverse_depth[i] = hn::LoadU(d, t.inverse_depth[i] + first);
  }
  out.area = cross(hn::Sub(out.x[1], out.x[0]), hn::Sub(out.y[1], out.y[0]),
                   hn::Sub(out.x[2], out.x[0]), hn::Sub(out.y[2], out.y[0]));
}

/// The edge from corner j to corner k, positive on the third corner's side.
HWY_INLINE void plan_edge(const Corners& c, int j, int k,
                          float (&out)[3][TrianglePlanes::kTriangles]) {
  const FloatTag d;
  const auto along_u = hn::CopySign(hn::Set(d, 1.0F), c.area);
  const auto du = hn::Mul(along_u, hn::Sub(c.y[j], c.y[k]));
  const auto dv = hn::Mul(along_u, hn::Sub(c.x[k], c.x[j]));
  const auto at_first = hn::Sub(hn::Zero(d), hn::Add(hn::Mul(du, c.x[j]), hn::Mul(dv, c.y[j])));
  const auto tolerance = hn::Mul(hn::Set(d, kEdgeTolerance_px), hn::Add(hn::Abs(du), hn::Abs(dv)));
  hn::Store(hn::Add(at_first, tolerance), d, out[0]);
  hn::Store(du, d, out[1]);
  hn::Store(dv, d, out[2]);
}

HWY_INLINE void plan_depth(const Corners& c, TrianglePlanes& out) {
  const FloatTag d;
  const auto scale = hn::Div(hn::Set(d, 1.0F), c.area);
  const auto to_1 = hn::Sub(c.inverse_depth[1], c.inverse_depth[0]);
  const auto to_2 = hn::Sub(c.inverse_depth[2], c.inverse_depth[0]);
  const auto du =
      hn::Mul(scale, cross(to_1, hn::Sub(c.y[1], c.y[0]), to_2, hn::Sub(c.y[2], c.y[0])));
  const auto dv =
      hn::Mul(scale, cross(hn::Sub(c.x[1], c.x[0]), to_1, hn::Sub(c.x[2], c.x[0]), to_2));
  const auto at_first =
      hn::Sub(c.inverse_depth[0], hn::Add(hn::Mul(du, c.x[0]), hn::Mul(dv, c.y[0])));
  hn::Store(at_first, d, out.inverse_depth[0]);
  hn::Store(du, d, out.inverse_depth[1]);
  hn::Store(dv, d, out.inverse_depth[2]);
  hn::Store(least(c.inverse_depth), d, out.inverse_depth_lo);
  hn::Store(greatest(c.inverse_depth), d, out.inverse_depth_hi);
}

/// Plans one vector of triangles. Returns which of them have an area in the image: the others are
/// seen edge on, and what they could show belongs to their neighbours.
HWY_INLINE LaneMask plan(const ImageTriangles& triangles, int first, TrianglePlanes& out) {
  const FloatTag d;
  Corners corners;
  load_corners(triangles, first, corners);
  plan_edge(corners, 1, 2, out.edge[0]);
  plan_edge(corners, 2, 0, out.edge[1]);
  plan_edge(corners, 0, 1, out.edge[2]);
  plan_depth(corners, out);
  hn::Store(hn::LoadU(d, triangles.first_u + first), d, out.u);
  hn::Store(hn::LoadU(d, triangles.first_v + first), d, out.v);
  hn::Store(hn::LoadU(d, triangles.last_du + first), d, out.last_du);
  hn::Store(hn::LoadU(d, triangles.last_dv + first), d, out.last_dv);
  constexpr float kLeastArea_px2 = 1e-10F;
  return hn::Gt(hn::Abs(corners.area), hn::Set(d, kLeastArea_px2));
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
