#include "settings.hpp"

#include <algorithm>

namespace berth::python {

std::string type_of(const SettingRef& setting) {
  const std::string type = setting.kind == SettingKind::flag     ? "bool"
                           : setting.kind == SettingKind::whole  ? "int"
                           : setting.kind == SettingKind::number ? "float"
                                                                 : "str";
  return setting.is_optional ? "Optional[" + type + "]" : type;
}

const SettingRef& setting_named(const std::vector<SettingRef>& settings, const std::string& group,
                                const std::string& name) {
  const auto found = std::ranges::find(settings, name, &SettingRef::name);
  if (found != settings.end()) return *found;
  std::string names;
  for (const SettingRef& setting : settings) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", setting.name);
  }
  throw py::type_error(
      fmt::format("{}: \"{}\" is no setting; expected one of {}", group, name, names));
}

SettingValue value_from(const py::handle& value, const std::string& group,
                        const SettingRef& setting) {
  if (setting.is_optional && value.is_none()) return {};
  const auto number = [&](auto given) {
    if (setting.domain.holds(given)) return SettingValue(given);
    throw_bad_setting(group, setting.name, given, setting.expected());
  };
  try {
    if (setting.kind == SettingKind::flag) return value.cast<bool>();
    if (setting.kind == SettingKind::whole) return number(value.cast<int>());
    if (setting.kind == SettingKind::number) return number(value.cast<double>());
  } catch (const py::cast_error&) {
    throw py::type_error(fmt::format("{}.{}: {}; expected {}", group, setting.name,
                                     std::string(py::repr(value)), type_of(setting)));
  }
  try {
    return setting.choice(std::string(py::str(value)));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}.{}: {}", group, setting.name, error.what()));
  }
}

py::dict dict_of(const std::vector<SettingRef>& settings) {
  py::dict all;
  for (const SettingRef& setting : settings) {
    all[py::str(std::string(setting.name))] = py::cast(setting.value);
  }
  return all;
}

std::string values_text(const std::vector<SettingRef>& settings) {
  std::string text;
  for (const SettingRef& setting : settings) {
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", setting.name,
                        std::string(py::repr(py::cast(setting.value))));
  }
  return text;
}

}  // namespace berth::python
