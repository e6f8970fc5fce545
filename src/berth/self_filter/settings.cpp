#include "berth/self_filter/settings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace berth {

void validate(const SelfFilterSettings& settings) {
  const SettingCheck check{"self_filter"};
  visit_settings(settings, check);
  check({"robot_region_scale", {.least = 1, .has_off = true}, ""}, settings.robot_region_scale);
  for (const double padding_m : settings.link_padding_m) {
    if (!std::isnan(padding_m)) check({"link_padding_m", kNotNegative, ""}, padding_m);
  }
}

void require_region(const SelfFilterSettings& settings, bool is_given) {
  if (is_given == (settings.robot_region_scale > 0)) return;
  throw std::invalid_argument(
      fmt::format("self_filter.robot_region_scale: {}; expected {}", settings.robot_region_scale,
                  is_given ? "the scale of the region that is given" : "0 without a region"));
}

}  // namespace berth
