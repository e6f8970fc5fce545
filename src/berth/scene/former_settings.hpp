// Settings that there were.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "berth/files/yaml_value.hpp"

namespace berth {

/// Of this group: a scene may have them for one version more, and they do nothing.
std::vector<std::string_view> ended_settings(std::string_view group);

/// Throws where `sensor` has the former `holes: obstacle`: without it a distance would be too
/// large.
void require_no_hole_policy(const YamlMap& sensor);

/// One sentence for each of ended_settings() that a scene's document has, with file and line.
std::vector<std::string> ended_settings_in(const YamlValue& document);

}  // namespace berth
