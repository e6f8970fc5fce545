#include "berth/scene/former_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace berth {
namespace {

struct Renamed {
  std::string_view former;
  std::string_view name;
};

constexpr std::array<Renamed, 7> kRenamed = {{
    {"slab_m", "surface_thickness_m"},
    {"carve_margin_m", "free_space_margin_m"},
    {"carve_max_age_s", "free_space_max_age_s"},
    {"island_radius_m", "flying_patch_radius_m"},
    {"island_jump_m", "flying_patch_jump_m"},
    {"hidden", "unknown"},
    {"doubtful", "rejected"},
}};

/// Of `separation`: the speed rises as soon as there is room, and the way that the robot takes is
/// looked at.
constexpr std::array<std::string_view, 3> kEnded = {"directed_speed", "hold_s", "release_m"};

constexpr std::array<std::string_view, 3> kGroups = {"space", "self_filter", "separation"};

void tell_group(const YamlValue& group, std::vector<std::string>& told) {
  if (!group.is_map()) return;
  for (const auto& [key, value] : group.entries()) {
    if (std::ranges::find(kEnded, key) != kEnded.end()) {
      told.push_back(fmt::format("{}:{}: {} is no setting any more, and has no effect",
                                 value.place().file.string(), value.place().line, key));
    }
    const auto found = std::ranges::find(kRenamed, key, &Renamed::former);
    if (found == kRenamed.end()) continue;
    told.push_back(
        fmt::format("{}:{}: {} is called {} now; the former name is read for one version more",
                    value.place().file.string(), value.place().line, found->former, found->name));
  }
}

void tell_all(const YamlValue& value, std::vector<std::string>& told) {
  if (value.is_list()) {
    for (const YamlValue& item : value.list()) tell_all(item, told);
  }
  if (!value.is_map()) return;
  for (const auto& [key, entry] : value.entries()) {
    const bool is_group = std::ranges::find(kGroups, key) != kGroups.end();
    is_group ? tell_group(entry, told) : tell_all(entry, told);
  }
}

}  // namespace

std::string_view former_name(std::string_view name) {
  const auto found = std::ranges::find(kRenamed, name, &Renamed::name);
  return found == kRenamed.end() ? std::string_view() : found->former;
}

std::span<const std::string_view> ended_settings() { return kEnded; }

std::vector<std::string> former_names_in(const YamlValue& document) {
  std::vector<std::string> told;
  tell_all(document, told);
  return told;
}

}  // namespace berth
