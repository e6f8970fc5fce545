#include "berth/self_filter/settings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace berth {
namespace {

void require_not_negative(const char* key, double value) {
  if (std::isfinite(value) && value >= 0) return;
  throw std::invalid_argument(
      fmt::format("self_filter.{}: {}; expected a finite number of at least 0", key, value));
}

void require_scale(const char* key, double value) {
  if (value == 0 || (std::isfinite(value) && value >= 1)) return;
  throw std::invalid_argument(fmt::format(
      "self_filter.{}: {}; expected a finite number of at least 1, or 0 (off)", key, value));
}

}  // namespace

double SelfFilterSettings::padding_of(LinkId id) const {
  const std::size_t i = static_cast<std::size_t>(id) - 1;
  return i < link_padding_m.size() && !std::isnan(link_padding_m[i]) ? link_padding_m[i]
                                                                     : padding_m;
}

void validate(const SelfFilterSettings& settings) {
  require_not_negative("tolerance_m", settings.tolerance_m);
  require_not_negative("tolerance_per_m", settings.tolerance_per_m);
  require_not_negative("tolerance_per_m2", settings.tolerance_per_m2);
  require_not_negative("padding_m", settings.padding_m);
  for (const double padding_m : settings.link_padding_m) {
    if (!std::isnan(padding_m)) require_not_negative("link_padding_m", padding_m);
  }
  require_not_negative("padding_depth_m", settings.padding_depth_m);
  require_not_negative("dilation_px", settings.dilation_px);
  require_not_negative("edge_jump_m", settings.edge_jump_m);
  require_not_negative("island_radius_m", settings.island_radius_m);
  require_not_negative("island_jump_m", settings.island_jump_m);
  require_scale("robot_region_scale", settings.robot_region_scale);
}

void require_region(const SelfFilterSettings& settings, bool is_given) {
  if (is_given == (settings.robot_region_scale > 0)) return;
  throw std::invalid_argument(
      fmt::format("self_filter.robot_region_scale: {}; expected {}", settings.robot_region_scale,
                  is_given ? "the scale of the region that is given" : "0 without a region"));
}

}  // namespace berth
