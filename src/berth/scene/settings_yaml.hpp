// Inside scene/ only: settings structs from maps of a YAML file, by their visit_settings().
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "berth/files/yaml_value.hpp"
#include "berth/types/setting.hpp"

namespace berth {

/// The one of its kind whose name the value is.
template <class Enum>
Enum read_enum(const YamlValue& value) {
  const auto& all = all_of(Enum{});
  std::vector<std::string_view> names;
  for (const Enum one : all) names.push_back(name_of(one));
  const std::string name = value.one_of(names);
  return *std::find_if(all.begin(), all.end(), [&](Enum one) { return name_of(one) == name; });
}

inline void read_setting(const YamlValue& value, const Domain&, bool& out) {
  out = value.boolean();
}
inline void read_setting(const YamlValue& value, const Domain& domain, int& out) {
  out = value.count();
  if (!domain.holds(out)) value.fail(domain.text(true));
}
inline void read_setting(const YamlValue& value, const Domain& domain, double& out) {
  out = domain.is_open     ? value.positive()
        : domain.least < 0 ? value.number()
                           : value.non_negative();
  if (!domain.holds(out)) value.fail(domain.text(false));
}
template <class Enum>
requires std::is_enum_v<Enum>
void read_setting(const YamlValue& value, const Domain&, Enum& out) {
  out = read_enum<Enum>(value);
}
template <class T>
void read_setting(const YamlValue& value, const Domain& domain, std::optional<T>& out) {
  read_setting(value, domain, out.emplace());
}

template <class Settings>
std::vector<std::string_view> setting_names(const Settings& settings) {
  std::vector<std::string_view> names;
  visit_settings(settings,
                 [&](const Setting& setting, const auto&) { names.push_back(setting.name); });
  return names;
}

/// Sets what the map gives; other keys of it belong to somebody else. Throws as YamlValue does.
template <class Settings>
void read_settings(const YamlMap& map, Settings& settings) {
  visit_settings(settings, [&](const Setting& setting, auto& value) {
    if (const auto given = map.find(setting.name)) {
      read_setting(*given, setting.domain, value);
    }
  });
}

/// The same for a map that has no other keys but `others`.
template <class Settings>
YamlMap read_settings(const YamlValue& value, Settings& settings,
                      const std::vector<std::string_view>& others = {}) {
  std::vector<std::string_view> known = others;
  const std::vector<std::string_view> names = setting_names(settings);
  known.insert(known.end(), names.begin(), names.end());
  const YamlMap map(value, known);
  read_settings(map, settings);
  return map;
}

}  // namespace berth
