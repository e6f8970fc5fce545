// Patches and triangles of a link as seen from another frame, 16 at a time, and how near they can
// be to convex pieces of space.
#if defined(BERTH_MESH_PATCHES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_MESH_PATCHES_INL_HPP
#undef BERTH_MESH_PATCHES_INL_HPP
#else
#define BERTH_MESH_PATCHES_INL_HPP
#endif

#include "berth/distance/robot_patches.hpp"
#include "berth/types/camera.hpp"
#include "berth/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {
using namespace berth::HWY_NAMESPACE;

struct Vectors {
  Lanes x, y, z;
};

HWY_INLINE Vectors operator-(const Vectors& a, const Vectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Vectors mul_add(Lanes s, const Vectors& a, const Vectors& b) {
  return {mul_add(s, a.x, b.x), mul_add(s, a.y, b.y), mul_add(s, a.z, b.z)};
}
HWY_INLINE Lanes dot(const Vectors& a, const Vectors& b) {
  return mul_add(a.x, b.x, mul_add(a.y, b.y, a.z * b.z));
}
HWY_INLINE Vectors select(LaneMask mask, const Vectors& a, const Vectors& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

/// X_FL of a link's frame L in the frame F of the search, as floats.
struct Motion {
  float r[3][3];
  float t[3];
};

inline Motion motion_of(const Pose& X_FL) {
  Motion motion;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) motion.r[i][j] = static_cast<float>(X_FL.linear()(i, j));
    motion.t[i] = static_cast<float>(X_FL.translation()[i]);
  }
  return motion;
}

HWY_INLINE Vectors turned(const Motion& X, const Vectors& p) {
  const auto row = [&](int i) {
    return mul_add(Lanes(X.r[i][0]), p.x, mul_add(Lanes(X.r[i][1]), p.y, Lanes(X.r[i][2]) * p.z));
  };
  return {row(0), row(1), row(2)};
}
HWY_INLINE Vectors moved(const Motion& X, const Vectors& p) {
  const auto row = [&](int i) {
    return mul_add(Lanes(X.r[i][0]), p.x,
                   mul_add(Lanes(X.r[i][1]), p.y, mul_add(Lanes(X.r[i][2]), p.z, Lanes(X.t[i]))));
  };
  return {row(0), row(1), row(2)};
}

/// Patches in the frame of the search.
struct Patches {
  Vectors centre;
  Vectors axis;
  Lanes half_height;
  Lanes radius;
};

HWY_INLINE Patches load_patches(const PatchLevel& level, int first, const Motion& X) {
  const auto at = [&](const std::vector<float>& values) { return load(values.data() + first); };
  return {moved(X, {at(level.centre_m[0]), at(level.centre_m[1]), at(level.centre_m[2])}),
          turned(X, {at(level.axis[0]), at(level.axis[1]), at(level.axis[2])}),
          at(level.half_height_m), at(level.radius_m)};
}

/// The same patch in every lane.
HWY_INLINE Patches broadcast_patch(const PatchLevel& level, int index, const Motion& X) {
  const auto at = [&](const std::vector<float>& values) { return Lanes(values[index]); };
  return {moved(X, {at(level.centre_m[0]), at(level.centre_m[1]), at(level.centre_m[2])}),
          turned(X, {at(level.axis[0]), at(level.axis[1]), at(level.axis[2])}),
          at(level.half_height_m), at(level.radius_m)};
}

/// How far a patch reaches from its centre along -n.
HWY_INLINE Lanes reach_along(const Patches& patch, const Vectors& n) {
  const Lanes along = abs(dot(patch.axis, n));
  const Lanes across = root(greatest(Lanes(1.0f) - along * along, Lanes(0.0f)));
  return mul_add(patch.half_height, along, patch.radius * across);
}

/// Pieces of space before a camera, {d <= z <= e, a0 z <= x <= a1 z, b0 z <= y <= b1 z}: convex.
struct Chunks {
  Lanes a0, a1, b0, b1, d, e;
};

/// The nearest point to p, by Newton steps on the squared distance as a function of z.
template <int steps>
HWY_INLINE Vectors nearest_in(const Chunks& c, const Vectors& p) {
  const Lanes zero(0.0f);
  Lanes w = clamp(p.z, c.d, c.e);
  for (int i = 0; i < steps; ++i) {
    const Lanes x = p.x - clamp(p.x, c.a0 * w, c.a1 * w);
    const Lanes y = p.y - clamp(p.y, c.b0 * w, c.b1 * w);
    const Lanes a = select(x > zero, c.a1, select(x < zero, c.a0, zero));
    const Lanes b = select(y > zero, c.b1, select(y < zero, c.b0, zero));
    const Lanes slope = w - p.z - a * x - b * y;
    const Lanes curvature = mul_add(a, a, mul_add(b, b, Lanes(1.0f)));
    w = clamp(w - slope / curvature, c.d, c.e);
  }
  return {clamp(p.x, c.a0 * w, c.a1 * w), clamp(p.y, c.b0 * w, c.b1 * w), w};
}

/// The greatest n . q of all points q of the chunk.
HWY_INLINE Lanes reach_of(const Chunks& c, const Vectors& n) {
  const Lanes per_depth = n.z + greatest(c.a0 * n.x, c.a1 * n.x) + greatest(c.b0 * n.y, c.b1 * n.y);
  return greatest(c.d * per_depth, c.e * per_depth);
}

/// Boxes along the axes of the frame.
struct Boxes {
  Vectors centre;
  Lanes half;
};

template <int steps>
HWY_INLINE Vectors nearest_in(const Boxes& c, const Vectors& p) {
  return {clamp(p.x, c.centre.x - c.half, c.centre.x + c.half),
          clamp(p.y, c.centre.y - c.half, c.centre.y + c.half),
          clamp(p.z, c.centre.z - c.half, c.centre.z + c.half)};
}
HWY_INLINE Lanes reach_of(const Boxes& c, const Vectors& n) {
  return dot(c.centre, n) + c.half * (abs(n.x) + abs(n.y) + abs(n.z));
}

/// Of many points the one that is nearest to another, but for roundings.
struct NearestPoint {
  /// While none was taken, what it began with.
  Eigen::Vector3f point_m;
  float least2_m2 = HUGE_VALF;

  /// The nearest of the lanes of q to p, which is the same in each lane.
  HWY_INLINE void take(const Vectors& p, const Vectors& q) {
    const Vectors v = p - q;
    const Lanes length2 = dot(v, v);
    const float m2 = least_lane(length2);
    if (!(m2 < least2_m2)) return;
    least2_m2 = m2;
    const int lane = __builtin_ctzll(bits_of(length2 <= Lanes(m2)));
    alignas(64) float x[kLanes], y[kLanes], z[kLanes];
    store(q.x, x);
    store(q.y, y);
    store(q.z, z);
    point_m = {x[lane], y[lane], z[lane]};
  }
};

struct Direction {
  Vectors n;
  Lanes length;
};

/// From q to p; no longer than 1, so that it makes no bound greater than it is.
HWY_INLINE Direction direction(const Vectors& p, const Vectors& q) {
  const Vectors v = p - q;
  const Lanes length = root(dot(v, v));
  const Lanes scale = Lanes(1.0f) / greatest(length, Lanes(1e-12f));
  return {{v.x * scale, v.y * scale, v.z * scale}, length};
}

/// No point of the patch is nearer to the body than this, since a plane lies between them: for any
/// n of length 1, all of the patch has n . x >= n . c - reach and all of the body n . q <= its
/// reach. The roundings are not paid for.
template <class Bodies>
HWY_INLINE Lanes patch_bound(const Patches& patch, const Bodies& body) {
  const Direction to = direction(patch.centre, nearest_in<2>(body, patch.centre));
  return dot(patch.centre, to.n) - reach_along(patch, to.n) - reach_of(body, to.n);
}

struct Triangles {
  Vectors a, b, c;
};

HWY_INLINE Triangles load_triangles(const LinkPatches& link, int first, const Motion& X) {
  const auto at = [&](int k) { return load(link.corners_m[k].data() + first); };
  return {moved(X, {at(0), at(1), at(2)}), moved(X, {at(3), at(4), at(5)}),
          moved(X, {at(6), at(7), at(8)})};
}

/// The nearest point of each triangle to p, a + s ab + u ac, by the region of the plane that p lies
/// over; all regions share one division.
HWY_INLINE Vectors nearest_in(const Triangles& t, const Vectors& p) {
  const Lanes zero(0.0f), one(1.0f);
  const Vectors ab = t.b - t.a;
  const Vectors ac = t.c - t.a;
  const Vectors ap = p - t.a;
  const Vectors bp = p - t.b;
  const Vectors cp = p - t.c;
  const Lanes ab_a = dot(ab, ap), ac_a = dot(ac, ap);
  const Lanes ab_b = dot(ab, bp), ac_b = dot(ac, bp);
  const Lanes ab_c = dot(ab, cp), ac_c = dot(ac, cp);
  const Lanes over_a = ab_b * ac_c - ab_c * ac_b;
  const Lanes over_b = ab_c * ac_a - ab_a * ac_c;
  const Lanes over_c = ab_a * ac_b - ab_b * ac_a;
  Lanes s = over_b;
  Lanes u = over_c;
  Lanes of = over_a + over_b + over_c;
  // Edge b c, then a c, then a b.
  const Lanes from_b = ac_b - ab_b;
  const Lanes from_c = ab_c - ac_c;
  const LaneMask on_bc = both(over_a <= zero, both(from_b >= zero, from_c >= zero));
  s = select(on_bc, from_c, s);
  u = select(on_bc, from_b, u);
  of = select(on_bc, from_b + from_c, of);
  const LaneMask on_ac = both(over_b <= zero, both(ac_a >= zero, ac_c <= zero));
  s = select(on_ac, zero, s);
  u = select(on_ac, ac_a, u);
  of = select(on_ac, ac_a - ac_c, of);
  const LaneMask on_ab = both(over_c <= zero, both(ab_a >= zero, ab_b <= zero));
  s = select(on_ab, ab_a, s);
  u = select(on_ab, zero, u);
  of = select(on_ab, ab_a - ab_b, of);
  const LaneMask at_a = both(ab_a <= zero, ac_a <= zero);
  const LaneMask at_b = both(ab_b >= zero, ac_b <= ab_b);
  const LaneMask at_c = both(ac_c >= zero, ab_c <= ac_c);
  const Lanes scale = one / select(abs(of) > zero, of, one);
  s = clamp(s * scale, zero, one);
  u = clamp(u * scale, zero, one - s);
  // Where corners coincide, p may be at several.
  s = select(at_b, one, select(hn::Or(at_a, at_c), zero, s));
  u = select(hn::Or(at_a, at_b), zero, select(at_c, one, u));
  return mul_add(s, ab, mul_add(u, ac, t.a));
}

/// The least n . v of each triangle's points.
HWY_INLINE Lanes least_along(const Triangles& t, const Vectors& n) {
  return least(dot(t.a, n), least(dot(t.b, n), dot(t.c, n)));
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#endif
