#include "berth/space/settings.hpp"

namespace berth {

void validate(const SpaceSettings& settings) { visit_settings(settings, SettingCheck{"space"}); }

}  // namespace berth
