#include "berth/sensor/settings.hpp"

namespace berth {
std::string_view SensorSettings::first_rule() const {
  if (drops_speckle()) return "speckle_px";
  if (has_background()) return "background_frames";
  return {};
}

void validate(const SensorSettings& settings) { visit_settings(settings, SettingCheck{"sensor"}); }

}  // namespace berth
