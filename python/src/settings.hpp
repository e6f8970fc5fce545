// The lists of settings (visit_settings) as Python classes.
#pragma once

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "berth/types/setting.hpp"

namespace berth::python {

namespace py = pybind11;

/// A setting's value: an enumerator is its name, one that is not set None.
template <class T>
py::object value_of(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return py::str(std::string(name_of(value)));
  } else if constexpr (std::is_arithmetic_v<T>) {
    return py::cast(value);
  } else {
    return value ? value_of(*value) : py::none();
  }
}

/// The type of a setting's value, as annotations have it.
template <class T>
std::string type_of(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return "str";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return std::is_same_v<T, bool> ? "bool" : std::is_integral_v<T> ? "int" : "float";
  } else {
    return "Optional[" + type_of(typename std::decay_t<decltype(value)>::value_type{}) + "]";
  }
}

/// The other way. Throws TypeError for another type, std::invalid_argument for a name that there is
/// not.
template <class T>
void assign_value(const std::string& name, const py::handle& value, T& out) {
  if constexpr (std::is_enum_v<T>) {
    const std::string text = py::str(value);
    std::string known;
    for (const T one : all_of(T{})) {
      if (name_of(one) == text) {
        out = one;
        return;
      }
      known += (known.empty() ? "" : ", ") + std::string(name_of(one));
    }
    throw std::invalid_argument(fmt::format("{}: \"{}\"; expected one of {}", name, text, known));
  } else if constexpr (std::is_arithmetic_v<T>) {
    try {
      out = value.cast<T>();
    } catch (const py::cast_error&) {
      throw py::type_error(
          fmt::format("{}: {}; expected {}", name, std::string(py::repr(value)), type_of(out)));
    }
  } else if (value.is_none()) {
    out.reset();
  } else {
    assign_value(name, value, out.emplace());
  }
}

/// Sets one, or changes nothing. Throws TypeError for a name that there is not,
/// std::invalid_argument for a value outside of its domain.
template <class Settings>
void set_setting(const std::string& group, const std::string& name, const py::handle& value,
                 Settings& settings) {
  bool is_known = false;
  Settings changed = settings;
  visit_settings(changed, [&](const Setting& setting, auto& own) {
    if (setting.name != name) return;
    is_known = true;
    assign_value(group + "." + name, value, own);
    SettingCheck{group}(setting, own);
  });
  if (!is_known) {
    std::string names;
    visit_settings(settings, [&](const Setting& setting, const auto&) {
      names += (names.empty() ? "" : ", ") + std::string(setting.name);
    });
    throw py::type_error(
        fmt::format("{}: \"{}\" is no setting; expected one of {}", group, name, names));
  }
  settings = changed;
}

template <class Settings>
py::object get_setting(const Settings& settings, const std::string& name) {
  py::object found = py::none();
  visit_settings(settings, [&](const Setting& setting, const auto& value) {
    if (setting.name == name) found = value_of(value);
  });
  return found;
}

template <class Settings>
py::dict dict_of(const Settings& settings) {
  py::dict all;
  visit_settings(settings, [&](const Setting& setting, const auto& value) {
    all[py::str(std::string(setting.name))] = value_of(value);
  });
  return all;
}

/// A class with a property for each setting of the list, and a constructor that takes them by name.
template <class Settings>
void bind_settings(py::module_& m, const char* name, const std::string& group, const char* what) {
  const Settings defaults{};
  std::string arguments = "self";
  visit_settings(defaults, [&](const Setting& setting, const auto& value) {
    arguments += fmt::format(", {}: {} = {}", setting.name, type_of(value),
                             std::string(py::repr(value_of(value))));
  });
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
  visit_settings(defaults, [&](const Setting& setting, const auto& value) {
    const std::string key(setting.name);
    const std::string text = fmt::format("{}: {}", type_of(value), setting.sentence);
    settings.def_property(
        key.c_str(), [key](const Settings& own) { return get_setting(own, key); },
        [key, group](Settings& own, const py::object& to) { set_setting(group, key, to, own); },
        text.c_str());
  });
  settings.def("as_dict", &dict_of<Settings>, "as_dict(self) -> Dict[str, object]\n\nAll by name.");
  const std::string copied = fmt::format(" -> {}", name);
  settings.def("__copy__", [](const Settings& own) { return own; },
               ("__copy__(self)" + copied).c_str());
  settings.def("__deepcopy__", [](const Settings& own, const py::dict&) { return own; },
               ("__deepcopy__(self, memo: Dict[int, object])" + copied).c_str());
  settings.def(
      "__repr__",
      [name = std::string(name)](const Settings& own) {
        std::string text;
        visit_settings(own, [&](const Setting& setting, const auto& value) {
          text += fmt::format("{}{}={}", text.empty() ? "" : ", ", setting.name,
                              std::string(py::repr(value_of(value))));
        });
        return name + "(" + text + ")";
      },
      "__repr__(self) -> str");
}

}  // namespace berth::python
