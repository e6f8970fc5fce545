#include "berth/sensor/settings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace berth {
namespace {

void require(bool holds, const char* key, double value, const char* expected) {
  if (holds) return;
  throw std::invalid_argument(fmt::format("sensor.{}: {}; expected {}", key, value, expected));
}

void require_length(const char* key, double value) {
  require(std::isfinite(value) && value >= 0, key, value, "a finite number of at least 0");
}

}  // namespace

std::string_view name_of(HolePolicy policy) {
  constexpr std::array<std::string_view, 3> kNames = {"free", "obstacle", "nearest_neighbour"};
  return kNames.at(static_cast<std::size_t>(policy));
}

std::string_view SensorSettings::first_rule() const {
  if (drops_speckle()) return "speckle_px";
  if (averages()) return "average_frames";
  if (has_background()) return "background_frames";
  if (fills_holes()) return "holes";
  return {};
}

void validate(const SensorSettings& settings) {
  require_length("noise_m", settings.noise_m);
  require(settings.speckle_px >= 0, "speckle_px", settings.speckle_px, "a number of at least 0");
  require_length("speckle_jump_m", settings.speckle_jump_m);
  require(settings.average_frames >= 0 && settings.average_frames <= kMostAverageFrames,
          "average_frames", settings.average_frames, "a whole number from 0 to 100");
  require(settings.background_frames >= 0, "background_frames", settings.background_frames,
          "a number of at least 0");
  require_length("background_clearance_m", settings.background_clearance_m);
}

}  // namespace berth
