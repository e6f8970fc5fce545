#include "berth/scene/settings_yaml.hpp"

#include <string>

#include "berth/scene/former_settings.hpp"

namespace berth {
namespace {

SettingValue read_number(const YamlValue& value, const SettingRef& setting) {
  const Domain& domain = setting.domain;
  if (setting.kind == SettingKind::whole) {
    const int count = value.count();
    if (!domain.holds(count)) value.fail(setting.expected());
    return count;
  }
  const double number = domain.is_open     ? value.positive()
                        : domain.least < 0 ? value.number()
                                           : value.non_negative();
  if (!domain.holds(number)) value.fail(setting.expected());
  return number;
}

SettingValue read_value(const YamlValue& value, const SettingRef& setting) {
  if (setting.kind == SettingKind::flag) return value.boolean();
  if (setting.kind == SettingKind::choice) return setting.choice(value.one_of(setting.choices));
  return read_number(value, setting);
}

}  // namespace

YamlMap read_settings(const YamlValue& value, std::string_view group,
                      const std::vector<SettingRef>& settings,
                      const std::vector<std::string_view>& others) {
  std::vector<std::string_view> known = others;
  for (const SettingRef& setting : settings) known.push_back(setting.name);
  const YamlMap map(value, known, ended_settings(group));
  for (const SettingRef& setting : settings) {
    if (const auto given = map.find(setting.name)) setting.set(read_value(*given, setting));
  }
  return map;
}

}  // namespace berth
