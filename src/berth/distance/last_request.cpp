#include "berth/distance/last_request.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace berth::mesh {

LinkBall ball_of(const LinkPatches& link) {
  const PatchLevel& top = link.levels.back();
  return {{top.centre_m[0][0], top.centre_m[1][0], top.centre_m[2][0]},
          std::hypot(top.half_height_m[0], top.radius_m[0])};
}

float moved_at_most_m(const LinkPatches& link, const Pose& X_BL_before, const Pose& X_BL) {
  if (link.empty() || X_BL.matrix() == X_BL_before.matrix()) return 0;
  constexpr double kRounding_m = 1e-6;
  const auto [centre_L_m, radius_m] = ball_of(link);
  // A rotation by an angle a moves what is at 1 m from its axis by 2 sin(a / 2), which is the
  // difference's norm over the root of 2.
  const double turned = (X_BL.linear() - X_BL_before.linear()).norm() / std::numbers::sqrt2;
  const double moved_m = (X_BL * centre_L_m - X_BL_before * centre_L_m).norm();
  return static_cast<float>(moved_m + turned * radius_m + kRounding_m);
}

void keep_pair(LinkSearch& search) {
  constexpr float kRounding_m = 1e-6f;
  const double apart_m = (search.X_BL * search.robot_point_L_m - search.obstacle_point_B_m).norm();
  search.best_m = static_cast<float>(apart_m) + kRounding_m;
  if (search.is_known() && search.best_m < search.range_m) return;
  search.best_m = search.range_m;
  search.best_triangle = -1;
  search.best_is_hidden = false;
}

bool keep_front(float moved_m, LinkSearch& search) {
  // After a jump most of it is near enough again: beginning anew takes half of the time.
  constexpr float kMostMoved_m = 0.01f;
  if (moved_m > kMostMoved_m) return false;
  for (const mesh::Item& item : search.items.items()) search.front.put(item);
  search.items.clear();
  search.front.move(moved_m);
  if (search.front.empty() || search.front.size() > kMostItems) return false;
  return search.range_m <= search.front_range_m - search.front.drift_m();
}

void start(const LinkPatches& patches, const Pose& X_BL, const MeshRequest& request,
           LinkSearch& search) {
  ++search.request;
  search.given_up_m = std::numeric_limits<float>::infinity();
  search.link = &patches;
  search.X_BL = X_BL;
  search.range_m = static_cast<float>(request.range_m);
  search.tolerance_m = std::max(static_cast<float>(request.tolerance_m), kFinestTolerance_m);
  search.known_bound_m = 0;
}

}  // namespace berth::mesh
