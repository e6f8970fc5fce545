#include "berth/distance/settings.hpp"

namespace berth {

void validate(const DistanceSettings& settings) {
  visit_settings(settings, SettingCheck{"evaluation"});
}

void validate(const MeshRequest& request) {
  const SettingCheck check{"evaluation"};
  check({"range_m", kRange, ""}, request.range_m);
  check({"tolerance_m", kNotNegative, ""}, request.tolerance_m);
  check({"deadline_us", {.may_be_infinite = true}, ""}, request.deadline_us);
}

}  // namespace berth
