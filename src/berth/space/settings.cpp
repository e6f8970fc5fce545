#include "berth/space/settings.hpp"

#include <algorithm>
#include <cmath>

#include "berth/space/closed_free_depth.hpp"

namespace berth {

double detection_capability_m(const SpaceSettings& settings, const Camera& camera) {
  constexpr double kFar_m = 3, kLeast_m = 0.04;
  if (settings.detection_capability_m) return *settings.detection_capability_m;
  const double focal_px = std::min(camera.fx_px, camera.fy_px);
  const double told_m = 2 * kClosingTiers.back().least_radius_px() * kFar_m / focal_px;
  return std::max(kLeast_m, std::round(100 * told_m) / 100);
}

void validate(const SpaceSettings& settings) {
  const SettingCheck check{"space"};
  visit_settings(settings, check);
  check({"obstacle_speed_m_s", kNotNegative, ""}, settings.obstacle_speed_m_s);
}

}  // namespace berth
