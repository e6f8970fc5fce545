// A bound of the distance of a cube's points from the distances of its corners.
//
// For any set M, phi(q) = dist(q, M)^2 - |q|^2 is the least of linear functions, so it is concave:
// what lies between points has at least the value that lies between theirs. In a cube of edge E
// with q at t in [0, 1]^3 that says
//   dist(q)^2 >= f(t) = (trilinear in t between the corners' dist^2) - E^2 sum of t_i (1 - t_i).
#if defined(BERTH_MESH_CUBE_CORNERS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_MESH_CUBE_CORNERS_INL_HPP
#undef BERTH_MESH_CUBE_CORNERS_INL_HPP
#else
#define BERTH_MESH_CUBE_CORNERS_INL_HPP
#endif

#include <algorithm>
#include <array>
#include <cmath>

#include "berth/space/children-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

/// No more than the squared distances of a cube's corners; corner i at (i & 1, i >> 1 & 1, i >> 2).
struct CubeCorners {
  float squared_m2[8];
};

/// Of the greatest summand of f, what its sums may round away.
constexpr float kRoundedShare = 16 * std::numeric_limits<float>::epsilon();

/// How much f may be off by that.
HWY_INLINE float rounding_m2(const CubeCorners& corners, float edge_m) {
  const float* d = corners.squared_m2;
  return kRoundedShare * (*std::max_element(d, d + 8) + edge_m * edge_m);
}

/// f at the corners of a cube within the cube, from `t` on and with edges of `part`; at least 0.
inline CubeCorners corners_within(const CubeCorners& corners, float edge_m,
                                  const std::array<float, 3>& t, float part) {
  const float* d = corners.squared_m2;
  const float rounding = rounding_m2(corners, edge_m);
  CubeCorners within;
  for (int i = 0; i < 8; ++i) {
    const float x = t[0] + (i & 1 ? part : 0);
    const float y = t[1] + (i & 2 ? part : 0);
    const float z = t[2] + (i & 4 ? part : 0);
    const float below = (1 - y) * ((1 - x) * d[0] + x * d[1]) + y * ((1 - x) * d[2] + x * d[3]);
    const float above = (1 - y) * ((1 - x) * d[4] + x * d[5]) + y * ((1 - x) * d[6] + x * d[7]);
    const float sags = x * (1 - x) + y * (1 - y) + z * (1 - z);
    const float f = (1 - z) * below + z * above - edge_m * edge_m * sags - rounding;
    within.squared_m2[i] = std::max(f, 0.0f);
  }
  return within;
}

/// No point of the mesh is nearer to the cube's centre.
inline float centre_distance_m(const CubeCorners& corners, float edge_m) {
  float sum = 0;
  for (const float squared_m2 : corners.squared_m2) sum += squared_m2;
  return std::sqrt(
      std::max(0.0f, sum / 8 - 0.75f * edge_m * edge_m - rounding_m2(corners, edge_m)));
}

/// Along an axis f is a quadratic, whose least value lies at an end unless the ends differ by less
/// than E^2; `step` is the least that they do on the four edges along the axis, 0 if it changes
/// sign. How far below its ends the quadratic goes.
HWY_INLINE Lanes sag(const Lanes (&f)[8], int axis, Lanes edge2_m2) {
  const int along = 1 << axis;
  Lanes least_step(HUGE_VALF), greatest_step(-HUGE_VALF);
  for (int i = 0; i < 8; ++i) {
    if (i & along) continue;
    const Lanes step = f[i | along] - f[i];
    least_step = least(least_step, step);
    greatest_step = greatest(greatest_step, step);
  }
  const Lanes step = greatest(greatest(least_step, -greatest_step), Lanes(0.0f));
  const Lanes missing = greatest(edge2_m2 - step, Lanes(0.0f));
  return missing * missing * (Lanes(0.25f) / edge2_m2);
}

/// The least distance of cubes of these edges by f at their corners.
HWY_INLINE Lanes least_distance(const Lanes (&f)[8], Lanes edge2_m2) {
  Lanes least_f = f[0];
  Lanes greatest_f = f[0];
  for (int i = 1; i < 8; ++i) {
    least_f = least(least_f, f[i]);
    greatest_f = greatest(greatest_f, f[i]);
  }
  const Lanes rounding = Lanes(kRoundedShare) * (abs(greatest_f) + edge2_m2);
  const Lanes bound2 =
      least_f - sag(f, 0, edge2_m2) - sag(f, 1, edge2_m2) - sag(f, 2, edge2_m2) - rounding;
  return root(greatest(bound2, Lanes(0.0f)));
}

HWY_INLINE float least_distance_m(const CubeCorners& corners, float edge_m) {
  Lanes f[8] = {Lanes(corners.squared_m2[0]), Lanes(corners.squared_m2[1]),
                Lanes(corners.squared_m2[2]), Lanes(corners.squared_m2[3]),
                Lanes(corners.squared_m2[4]), Lanes(corners.squared_m2[5]),
                Lanes(corners.squared_m2[6]), Lanes(corners.squared_m2[7])};
  return hn::GetLane(least_distance(f, Lanes(edge_m * edge_m)).v);
}

/// The same of the cube's 64 children, of which those that are not `wanted` may be left out.
HWY_INLINE void bound_child_cubes(const CubeCorners& corners, float edge_m, std::uint64_t wanted,
                                  float (&out_m)[64]) {
  const float edge2_m2 = edge_m * edge_m;
  const float* d = corners.squared_m2;
  // The coefficients of 1, x, y, z, xy, xz, yz and xyz.
  const float c0 = d[0], cx = d[1] - d[0], cy = d[2] - d[0], cz = d[4] - d[0];
  const float cxy = d[3] - d[2] - cx, cxz = d[5] - d[4] - cx, cyz = d[6] - d[4] - cy;
  const float cxyz = d[7] - d[6] - d[5] + d[4] - cxy;
  const Lanes quarter(0.25f), edge2(edge2_m2), one(1.0f);
  const Lanes rounding(rounding_m2(corners, edge_m));
  for (int i = 0; i < 64; i += kLanes) {
    if (!has_wanted(wanted, i)) continue;
    const CubePoints at = child_places(i);
    Lanes f[8] = {one, one, one, one, one, one, one, one};
    for (int k = 0; k < 8; ++k) {
      const Lanes x = (at.x + Lanes(k & 1 ? 1.0f : 0.0f)) * quarter;
      const Lanes y = (at.y + Lanes(k & 2 ? 1.0f : 0.0f)) * quarter;
      const Lanes z = (at.z + Lanes(k & 4 ? 1.0f : 0.0f)) * quarter;
      const Lanes at_x0 = mul_add(Lanes(cz), z, mul_add(Lanes(cy) + Lanes(cyz) * z, y, Lanes(c0)));
      const Lanes per_x =
          mul_add(Lanes(cxz), z, mul_add(Lanes(cxy) + Lanes(cxyz) * z, y, Lanes(cx)));
      const Lanes sags = x * (one - x) + y * (one - y) + z * (one - z);
      f[k] = mul_add(per_x, x, at_x0) - edge2 * sags - rounding;
    }
    store(least_distance(f, Lanes(edge2_m2 / 16)), out_m + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#endif
