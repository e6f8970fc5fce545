#include "berth/scene/setting_schema.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "berth/files/setting_json.hpp"

namespace berth {
namespace {

/// 1 and not 1.0 for a whole number.
Json number_json(double value) {
  const auto whole = static_cast<std::int64_t>(value);
  return static_cast<double>(whole) == value ? Json(whole) : Json(value);
}

/// The numbers of a domain that a file can have: it has no infinite ones.
Json range_schema(const Domain& domain, bool is_whole) {
  Json range;
  // Files have no whole number below 0.
  const double least = is_whole ? std::max(domain.least, 0.0) : domain.least;
  if (std::isfinite(least))
    range[domain.is_open ? "exclusiveMinimum" : "minimum"] = number_json(least);
  if (std::isfinite(domain.most)) range["maximum"] = number_json(domain.most);
  return domain.has_off ? Json{{"anyOf", {{{"const", 0}}, range}}} : range;
}

/// What it may be.
Json value_schema(const SettingRef& setting) {
  if (setting.kind == SettingKind::flag) return {{"type", "boolean"}};
  if (setting.kind == SettingKind::choice) return {{"enum", setting.choices}};
  const bool is_whole = setting.kind == SettingKind::whole;
  Json schema{{"type", is_whole ? "integer" : "number"}};
  schema.update(range_schema(setting.domain, is_whole));
  return schema;
}

}  // namespace

Json setting_properties(const std::vector<SettingRef>& settings) {
  Json properties = Json::object();
  for (const SettingRef& setting : settings) {
    Json& property = properties[setting.name] =
        schema::told(std::string(setting.sentence), value_schema(setting));
    // No file can say that a number is infinite.
    const Json standing = setting_json(setting.value, [](double value) {
      return std::isfinite(value) ? number_json(value) : Json();
    });
    if (!standing.is_null()) property["default"] = standing;
  }
  return properties;
}

}  // namespace berth
