// Inside berth only: settings as JSON Schema (draft 2020-12), made from their visit_settings().
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

#include "berth/files/json_schema.hpp"
#include "berth/types/setting.hpp"

namespace berth {

/// 1 and not 1.0 for a whole number.
inline Json number_json(double value) {
  const auto whole = static_cast<std::int64_t>(value);
  return static_cast<double>(whole) == value ? Json(whole) : Json(value);
}

/// The numbers of a domain that a file can have: it has no infinite ones.
inline Json range_schema(const Domain& domain, bool is_whole) {
  Json range;
  // Files have no whole number below 0.
  const double least = is_whole ? std::max(domain.least, 0.0) : domain.least;
  if (std::isfinite(least))
    range[domain.is_open ? "exclusiveMinimum" : "minimum"] = number_json(least);
  if (std::isfinite(domain.most)) range["maximum"] = number_json(domain.most);
  return domain.has_off ? Json{{"anyOf", {{{"const", 0}}, range}}} : range;
}

/// What a setting like this one may be.
template <class T>
Json value_schema(const Domain& domain, const T&) {
  if constexpr (std::is_same_v<T, bool>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::is_enum_v<T>) {
    Json names = Json::array();
    for (const T one : all_of(T{})) names.push_back(name_of(one));
    return {{"enum", names}};
  } else {
    Json schema{{"type", std::is_integral_v<T> ? "integer" : "number"}};
    schema.update(range_schema(domain, std::is_integral_v<T>));
    return schema;
  }
}
template <class T>
Json value_schema(const Domain& domain, const std::optional<T>&) {
  return value_schema(domain, T{});
}

/// Null where no file can say it.
template <class T>
Json value_json(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return name_of(value);
  } else if constexpr (std::is_same_v<T, bool>) {
    return value;
  } else {
    return std::isfinite(static_cast<double>(value)) ? number_json(value) : Json();
  }
}
template <class T>
Json value_json(const std::optional<T>& value) {
  return value ? value_json(*value) : Json();
}

/// One property for each setting, with its sentence and what stands in `settings` as its default.
template <class Settings>
Json setting_properties(const Settings& settings) {
  Json properties = Json::object();
  visit_settings(settings, [&](const Setting& setting, const auto& value) {
    std::string sentence(setting.sentence);
    Json& property = properties[setting.name] =
        schema::told(sentence, value_schema(setting.domain, value));
    if (Json standing = value_json(value); !standing.is_null()) {
      property["default"] = standing;
    }
  });
  return properties;
}

}  // namespace berth
