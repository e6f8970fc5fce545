#include "berth/distance/settings.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace berth {

void validate(const DistanceSettings& settings) {
  if (std::isfinite(settings.range_m) && settings.range_m > 0) return;
  throw std::invalid_argument("range_m is " + std::to_string(settings.range_m) +
                              ", expected a finite number above 0");
}

}  // namespace berth
