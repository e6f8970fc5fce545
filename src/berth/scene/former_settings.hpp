// Settings that have changed their names: the former ones are read for one version more.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "berth/files/yaml_value.hpp"

namespace berth {

/// The name that this setting of this group ("space", "separation" and so on) had before; empty
/// where it had none. Names are unique over groups but for those of `separation`.
std::string_view former_name(std::string_view name);

/// Of this group: a scene may have them for one version more, and they do nothing.
std::vector<std::string_view> ended_settings(std::string_view group);

/// Throws where `sensor` has the former `holes: obstacle`: without it a distance would be too
/// large.
void require_no_hole_policy(const YamlMap& sensor);

/// One sentence for each former name that a scene's document uses, and for each of
/// ended_settings(), with file and line.
std::vector<std::string> former_names_in(const YamlValue& document);

}  // namespace berth
