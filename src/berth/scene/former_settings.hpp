// Settings that have changed their names: the former ones are read for one version more.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "berth/files/yaml_value.hpp"

namespace berth {

/// The name that this setting of this group ("space", "separation" and so on) had before; empty
/// where it had none. Names are unique over groups but for those of `separation`.
std::string_view former_name(std::string_view name);

/// Of `separation`: a scene may have them for one version more, and they do nothing.
std::span<const std::string_view> ended_settings();

/// One sentence for each former name that a scene's document uses, and for each of
/// ended_settings(), with file and line.
std::vector<std::string> former_names_in(const YamlValue& document);

}  // namespace berth
