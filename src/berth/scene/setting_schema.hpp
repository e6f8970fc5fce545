// Inside berth only: settings as JSON Schema (draft 2020-12).
#pragma once

#include <vector>

#include "berth/files/json_schema.hpp"
#include "berth/types/setting.hpp"

namespace berth {

/// One property for each setting, with its sentence and its value as the default.
Json setting_properties(const std::vector<SettingRef>& settings);

}  // namespace berth
