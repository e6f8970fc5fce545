#pragma once

#include <string>
#include <vector>

#include "berth/files/json_schema.hpp"
#include "berth/types/setting.hpp"

namespace berth {

/// One property for each setting, with its sentence and its value as the default.
Json setting_properties(const std::vector<SettingRef>& settings);

/// What a scene file may be, as JSON Schema (draft 2020-12), in lines: keys, types, domains,
/// defaults and a sentence for each. It says what one value can show. What hangs on another value
/// or another file, such as a stamp for each image, read_scene() reports.
std::string scene_schema();

}  // namespace berth
