#include "berth/distance/mesh/settings.hpp"

namespace berth {

void validate(const SpaceSettings& settings) { visit_settings(settings, SettingCheck{"space"}); }

void validate(const MeshQuestion& question) {
  const SettingCheck check{"evaluation"};
  check({"range_m", kAboveZero, ""}, question.range_m);
  check({"tolerance_m", kNotNegative, ""}, question.tolerance_m);
  check({"deadline_us", {.may_be_infinite = true}, ""}, question.deadline_us);
}

}  // namespace berth
