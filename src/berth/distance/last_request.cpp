#include "berth/distance/last_request.hpp"

#include <cmath>
#include <numbers>

namespace berth::mesh {

float moved_at_most_m(const LinkPatches& link, const Pose& X_BL_before, const Pose& X_BL) {
  if (link.empty() || X_BL.matrix() == X_BL_before.matrix()) return 0;
  constexpr double kRounding_m = 1e-6;
  const PatchLevel& top = link.levels.back();
  const Eigen::Vector3d centre_L_m(top.centre_m[0][0], top.centre_m[1][0], top.centre_m[2][0]);
  const double radius_m = std::hypot(top.half_height_m[0], top.radius_m[0]);
  // A rotation by an angle a moves what is at 1 m from its axis by 2 sin(a / 2), which is the
  // difference's norm over the root of 2.
  const double turned = (X_BL.linear() - X_BL_before.linear()).norm() / std::numbers::sqrt2;
  const double moved_m = (X_BL * centre_L_m - X_BL_before * centre_L_m).norm();
  return static_cast<float>(moved_m + turned * radius_m + kRounding_m);
}

}  // namespace berth::mesh
