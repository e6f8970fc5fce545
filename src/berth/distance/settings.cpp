#include "berth/distance/settings.hpp"

namespace berth {

void validate(const DistanceSettings& settings) {
  visit_settings(settings, SettingCheck{"evaluation"});
}

void validate(const MeshQuestion& question) {
  const SettingCheck check{"evaluation"};
  check({"range_m", kAboveZero, ""}, question.range_m);
  check({"tolerance_m", kNotNegative, ""}, question.tolerance_m);
  check({"deadline_us", {.may_be_infinite = true}, ""}, question.deadline_us);
}

}  // namespace berth
