// Inside record/ only: settings structs as JSON, by their visit_settings().
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "berth/record/exact_json.hpp"
#include "berth/types/setting.hpp"

namespace berth {

template <class T>
Json setting_json(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return name_of(value);
  } else if constexpr (requires { value.has_value(); }) {
    return value ? setting_json(*value) : Json();
  } else if constexpr (std::is_floating_point_v<T>) {
    return exact(value);
  } else {
    return value;
  }
}

template <class Settings>
Json settings_json(const Settings& settings) {
  Json out = Json::object();
  visit_settings(settings, [&](const Setting& setting, const auto& value) {
    out[setting.name] = setting_json(value);
  });
  return out;
}

template <class T>
void take_setting(const Json& json, T& value) {
  if constexpr (std::is_enum_v<T>) {
    value = enum_of<T>(json, all_of(T{}).size());
  } else if constexpr (requires { value.has_value(); }) {
    value.reset();
    if (!json.is_null()) take_setting(json, value.emplace());
  } else if constexpr (std::is_floating_point_v<T>) {
    value = number_of(json);
  } else {
    value = json.get<T>();
  }
}

/// Throws std::runtime_error with the group and the key for a setting that is missing or no value
/// of its kind.
template <class Settings>
void take_settings(const Json& json, std::string_view group, Settings& settings) {
  visit_settings(settings, [&](const Setting& setting, auto& value) {
    try {
      take_setting(json.at(std::string(setting.name)), value);
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("{}.{}: {}", group, setting.name, error.what()));
    }
  });
}

}  // namespace berth
