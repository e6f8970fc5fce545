#include "berth/distance/settings.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace berth {

namespace {

void require(bool holds, const char* key, double value, const char* expected) {
  if (holds) return;
  throw std::invalid_argument(std::string(key) + " is " + std::to_string(value) + ", expected " +
                              expected);
}

}  // namespace

void validate(const DistanceSettings& settings) {
  require(std::isfinite(settings.range_m) && settings.range_m > 0, "range_m", settings.range_m,
          "a finite number above 0");
  require(std::isfinite(settings.tolerance_m) && settings.tolerance_m >= 0, "tolerance_m",
          settings.tolerance_m, "a finite number of at least 0");
  const double deadline_us = settings.deadline_us.value_or(0);
  require(deadline_us >= 0, "deadline_us", deadline_us, "a number of at least 0");
}

}  // namespace berth
