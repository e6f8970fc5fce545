// The lists of settings as Python classes.
#pragma once

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "berth/types/setting.hpp"

namespace berth::python {

namespace py = pybind11;

/// The type of a setting's value, as annotations have it.
std::string type_of(const SettingRef& setting);

/// The setting of this name. Throws TypeError with those that there are.
const SettingRef& setting_named(const std::vector<SettingRef>& settings, const std::string& group,
                                const std::string& name);

/// The other way. Throws TypeError for another type, std::invalid_argument for a value outside of
/// its domain.
SettingValue value_from(const py::handle& value, const std::string& group,
                        const SettingRef& setting);

py::dict dict_of(const std::vector<SettingRef>& settings);

/// Such as "range_m=1.0, tolerance_m=None".
std::string values_text(const std::vector<SettingRef>& settings);

/// Sets one, or changes nothing. Throws as the two above do.
template <class Settings>
void set_setting(const std::string& group, const std::string& name, const py::handle& value,
                 Settings& settings) {
  const std::vector<SettingRef> refs = setting_refs(settings);
  const SettingRef& setting = setting_named(refs, group, name);
  setting.set(value_from(value, group, setting));
}

/// A class with a property for each setting of the list, and a constructor that takes them by name.
template <class Settings>
void bind_settings(py::module_& m, const char* name, const std::string& group, const char* what) {
  const Settings defaults{};
  const std::vector<SettingRef> listed = setting_refs(defaults);
  std::string arguments = "self";
  for (const SettingRef& setting : listed) {
    arguments += fmt::format(", {}: {} = {}", setting.name, type_of(setting),
                             std::string(py::repr(py::cast(setting.value))));
  }
  py::options options;
  options.disable_function_signatures();
  py::class_<Settings> settings(m, name, what);
  settings.def(py::init([group](const py::kwargs& given) {
                 Settings made{};
                 for (const auto& [key, value] : given) {
                   set_setting(group, std::string(py::str(key)), value, made);
                 }
                 return made;
               }),
               fmt::format("__init__({}) -> None", arguments).c_str());
  for (const SettingRef& setting : listed) {
    const std::string key(setting.name);
    const std::string text = fmt::format("{}: {}", type_of(setting), setting.sentence);
    settings.def_property(
        key.c_str(),
        [key, group](const Settings& own) {
          const std::vector<SettingRef> refs = setting_refs(own);
          return py::cast(setting_named(refs, group, key).value);
        },
        [key, group](Settings& own, const py::object& to) { set_setting(group, key, to, own); },
        text.c_str());
  }
  settings.def(
      "as_dict", [](const Settings& own) { return dict_of(setting_refs(own)); },
      "as_dict(self) -> Dict[str, object]\n\nAll by name.");
  const std::string copied = fmt::format(" -> {}", name);
  settings.def(
      "__copy__", [](const Settings& own) { return own; }, ("__copy__(self)" + copied).c_str());
  settings.def(
      "__deepcopy__", [](const Settings& own, const py::dict&) { return own; },
      ("__deepcopy__(self, memo: Dict[int, object])" + copied).c_str());
  settings.def(
      "__repr__",
      [name = std::string(name)](const Settings& own) {
        return fmt::format("{}({})", name, values_text(setting_refs(own)));
      },
      "__repr__(self) -> str");
}

}  // namespace berth::python
