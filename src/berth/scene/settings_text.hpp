// What the documents say of the settings, made from the lists of settings themselves.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace berth {

/// The maps of settings in a scene file.
inline constexpr std::array<std::string_view, 7> kSettingGroups = {
    "self_filter", "sensor", "space", "watch", "evaluation", "time", "separation"};

/// A Markdown table of one of these maps: key, default in a scene file, values that it may have,
/// what it does. Ends in a line break. Throws std::invalid_argument for another group.
std::string settings_table(std::string_view group);

}  // namespace berth
