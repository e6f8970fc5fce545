// Cubes as a camera sees them, many at a time.
#if defined(BERTH_MESH_CUBE_PROJECTION_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_MESH_CUBE_PROJECTION_INL_HPP
#undef BERTH_MESH_CUBE_PROJECTION_INL_HPP
#else
#define BERTH_MESH_CUBE_PROJECTION_INL_HPP
#endif

#include <limits>

#include "berth/space/children-inl.hpp"
#include "berth/space/unknown_space.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

using IntTag = hn::RebindToSigned<FloatTag>;
using Ints = hn::Vec<IntTag>;

/// What rounding may do to a pixel's coordinate.
constexpr float kPixelError = 2e-3f;
/// A cube that reaches nearer to the camera's plane has no rectangle.
constexpr float kLeastDepth_m = 1e-4f;

/// Some cubes as a view sees them: the depths they reach from and to, and the pixels u0 to u1 and
/// v0 to v1, both included, that they project into, as far as these lie in the image.
struct Projection {
  FloatVector za, zb;
  Ints u0, v0, u1, v1;
  /// The most pixels beyond the first, in either direction.
  int span;
  /// A bit for each cube: some of these pixels are in the image, all of them are, and those of
  /// which nothing is known, since they reach through the camera's plane.
  std::uint64_t meets, inside, through;
};

struct Interval {
  Lanes lo;
  Lanes hi;
};

/// The least and greatest of the pixels, as floats, that a direction x / z and all that is no
/// farther from it than `reach` fall into.
HWY_INLINE Interval pixels_of(Lanes slope, Lanes reach, double focal_px, double centre_px) {
  const Lanes f(static_cast<float>(focal_px));
  const Lanes c(static_cast<float>(centre_px + 0.5));
  constexpr float kFar_px = 1e6f;
  const Lanes lo = clamp((slope - reach) * f + c, Lanes(-kFar_px), Lanes(kFar_px));
  const Lanes hi = clamp((slope + reach) * f + c, Lanes(-kFar_px), Lanes(kFar_px));
  return {hn::Floor((lo - Lanes(kPixelError)).v), hn::Floor((hi + Lanes(kPixelError)).v)};
}

HWY_INLINE Projection project(const FreeingCamera& view, const CubePoints& p_B, float reach_m,
                              float half_m) {
  const Eigen::Matrix3f R = view.X_CB.linear().cast<float>();
  const Eigen::Vector3f t = view.X_CB.translation().cast<float>();
  // Four roundings of numbers up to the sum of both lengths.
  const float error_m = 8 * std::numeric_limits<float>::epsilon() * (reach_m + t.norm());
  const auto row = [&](int i) HWY_ATTR {
    return mul_add(Lanes(R(i, 0)), p_B.x,
                   mul_add(Lanes(R(i, 1)), p_B.y, mul_add(Lanes(R(i, 2)), p_B.z, Lanes(t[i]))));
  };
  const Lanes z = row(2);
  const Lanes half_z(half_m * R.row(2).cwiseAbs().sum() + error_m);
  const Lanes za = z - half_z;
  const Lanes zb = z + half_z;
  const LaneMask is_before = za >= Lanes(kLeastDepth_m);
  const Lanes inv_z = Lanes(1.0f) / greatest(z, Lanes(kLeastDepth_m));
  const Lanes inv_za = Lanes(1.0f) / greatest(za, Lanes(kLeastDepth_m));
  // A point at d from the centre has the slope s + (d.x - s d.z) / z.
  const auto pixels = [&](int i, double focal_px, double centre_px) HWY_ATTR {
    const Lanes s = row(i) * inv_z;
    Lanes reach(0.0f);
    for (int k = 0; k < 3; ++k) reach = reach + abs(Lanes(R(i, k)) - s * Lanes(R(2, k)));
    reach = mul_add(Lanes(half_m), reach, Lanes(error_m) * (Lanes(1.0f) + abs(s)));
    return pixels_of(s, reach * inv_za, focal_px, centre_px);
  };
  const Camera& camera = view.space->camera;
  const Interval u = pixels(0, camera.fx_px, camera.cx_px);
  const Interval v = pixels(1, camera.fy_px, camera.cy_px);
  const Lanes zero(0.0f);
  const Lanes last_u(static_cast<float>(camera.width_px - 1));
  const Lanes last_v(static_cast<float>(camera.height_px - 1));
  const LaneMask meets =
      both(is_before, both(both(u.hi >= zero, u.lo <= last_u), both(v.hi >= zero, v.lo <= last_v)));
  const LaneMask inside =
      both(meets, both(both(u.lo >= zero, u.hi <= last_u), both(v.lo >= zero, v.hi <= last_v)));
  const Lanes u0 = clamp(u.lo, zero, last_u);
  const Lanes v0 = clamp(v.lo, zero, last_v);
  const Lanes u1 = clamp(u.hi, zero, last_u);
  const Lanes v1 = clamp(v.hi, zero, last_v);
  const IntTag ints;
  const float span = greatest_lane(select(meets, greatest(u1 - u0, v1 - v0), zero));
  const LaneMask is_behind_camera = zb <= zero;
  return {za.v,
          zb.v,
          hn::ConvertTo(ints, u0.v),
          hn::ConvertTo(ints, v0.v),
          hn::ConvertTo(ints, u1.v),
          hn::ConvertTo(ints, v1.v),
          static_cast<int>(span),
          bits_of(meets),
          bits_of(inside),
          bits_of(hn::Not(hn::Or(is_behind_camera, is_before)))};
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#endif
