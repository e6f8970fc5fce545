#include "berth/distance/mesh/settings.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace berth {
namespace {

void require_length(const char* key, double value, bool may_be_zero) {
  if (std::isfinite(value) && (may_be_zero ? value >= 0 : value > 0)) return;
  throw std::invalid_argument(std::string(key) + " is " + std::to_string(value) +
                              ", expected a finite number " +
                              (may_be_zero ? "of at least 0" : "above 0"));
}

}  // namespace

void validate(const SpaceSettings& settings) {
  require_length("slab_m", settings.slab_m, true);
  require_length("carve_margin_m", settings.carve_margin_m, true);
  require_length("behind_robot_m", settings.behind_robot_m, true);
  require_length("carve_max_age_s", settings.carve_max_age_s, true);
  require_length("obstacle_speed_m_s", settings.obstacle_speed_m_s, true);
}

void validate(const MeshQuestion& question) {
  require_length("range_m", question.range_m, false);
  require_length("tolerance_m", question.tolerance_m, true);
  const double deadline_us = question.deadline_us.value_or(0);
  if (deadline_us >= 0) return;
  throw std::invalid_argument("deadline_us is " + std::to_string(deadline_us) +
                              ", expected a number of at least 0");
}

}  // namespace berth
