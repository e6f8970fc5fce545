// Inside scene/ only: settings from maps of a YAML file.
#pragma once

#include <string_view>
#include <vector>

#include "berth/files/yaml_value.hpp"
#include "berth/types/setting.hpp"

namespace berth {

/// Sets what the map gives. It has no other keys but `others` and the ended_settings() of its
/// group. Throws as YamlValue does.
YamlMap read_settings(const YamlValue& value, std::string_view group,
                      const std::vector<SettingRef>& settings,
                      const std::vector<std::string_view>& others = {});

}  // namespace berth
