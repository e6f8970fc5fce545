#include "berth/sensor/settings.hpp"

namespace berth {
std::string_view name_of(HolePolicy policy) {
  constexpr std::array<std::string_view, 2> kNames = {"free", "obstacle"};
  return kNames.at(static_cast<std::size_t>(policy));
}

std::string_view SensorSettings::first_rule() const {
  if (drops_speckle()) return "speckle_px";
  if (averages()) return "average_frames";
  if (has_background()) return "background_frames";
  if (fills_holes()) return "holes";
  return {};
}

void validate(const SensorSettings& settings) { visit_settings(settings, SettingCheck{"sensor"}); }

}  // namespace berth
