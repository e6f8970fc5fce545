// A setting is written once: in its struct, and in visit_settings() beside it, which reports its
// name, domain and one sentence. Validation, scene files, the command line and its help, and the
// tables in the documents are made from that. The name ends in the unit (_m, _px, _s, _us).
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace berth {

/// The numbers that a setting may be.
struct Domain {
  double least = 0;
  /// The least itself is not one of them.
  bool is_open = false;
  double most = std::numeric_limits<double>::infinity();
  /// 0 is one of them as well, and turns the rule off.
  bool has_off = false;
  bool may_be_infinite = false;

  bool holds(double value) const;
  /// Such as "a finite number of at least 0".
  std::string text(bool is_whole) const;
};

inline constexpr Domain kNotNegative{};               ///< 0 and more
inline constexpr Domain kAboveZero{.is_open = true};  ///< without the 0

/// What the list says of one setting.
struct Setting {
  std::string_view name;
  Domain domain;
  /// What it does, for people; begins in small letters.
  std::string_view sentence;
};

/// A settings struct, constant or not.
template <class Settings, class Struct>
concept SettingsOf = std::is_same_v<std::remove_const_t<Settings>, Struct>;

/// Throws std::invalid_argument("<group>.<name>: <value>; expected <domain>").
[[noreturn]] void throw_bad_setting(std::string_view group, std::string_view name, double value,
                                    std::string_view expected);

/// For visit_settings(): checks that a number lies in its domain. Settings of other types cannot
/// hold a wrong value.
struct SettingCheck {
  std::string_view group;

  template <class T>
  void operator()(const Setting& setting, const T& value) const {
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      if (setting.domain.holds(value)) return;
      throw_bad_setting(group, setting.name, value, setting.domain.text(std::is_integral_v<T>));
    } else if constexpr (requires { value.has_value(); }) {
      if (value) (*this)(setting, *value);
    }
  }
};

/// What a list of fields says of one of them.
struct Field {
  /// As in JSON and Python; ends in frame and unit.
  std::string_view name;
  /// What it is, for people; stands alone.
  std::string_view sentence;
};

/// std::monostate where an optional setting is not set; of a choice the name.
using SettingValue = std::variant<std::monostate, bool, int, double, std::string_view>;

/// What a setting is, whether it is optional or not.
enum class SettingKind { flag, whole, number, choice };

/// Of a field of a settings struct.
template <class T>
SettingValue setting_value(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return name_of(value);
  } else if constexpr (requires { value.has_value(); }) {
    return value ? setting_value(*value) : SettingValue();
  } else {
    return value;
  }
}

/// The other way. The value is of the field's kind; else std::bad_variant_access.
template <class T>
void assign_setting(const SettingValue& value, T& out) {
  if constexpr (std::is_enum_v<T>) {
    const std::string_view name = std::get<std::string_view>(value);
    out = *std::ranges::find_if(all_of(T{}), [&](T one) { return name_of(one) == name; });
  } else if constexpr (requires { out.has_value(); }) {
    std::holds_alternative<std::monostate>(value) ? out.reset()
                                                  : assign_setting(value, out.emplace());
  } else {
    out = std::get<T>(value);
  }
}

/// A setting of a struct, which it refers to: for what knows types only when the program runs, such
/// as files, options, parameters and pages.
struct SettingRef : Setting {
  SettingKind kind = SettingKind::number;
  bool is_optional = false;
  /// The names of a choice.
  std::vector<std::string_view> choices;
  /// As it was when this was made.
  SettingValue value;
  /// Takes a value of the kind, one of the choices, or std::monostate where it is optional. Empty
  /// for a constant struct.
  std::function<void(const SettingValue&)> set;

  template <class T>
  SettingRef(const Setting& setting, T& now) : Setting(setting), value(setting_value(now)) {
    take_kind(std::remove_const_t<T>());
    if constexpr (!std::is_const_v<T>) {
      set = [&now](const SettingValue& to) { assign_setting(to, now); };
    }
  }

  bool is_number() const { return kind == SettingKind::whole || kind == SettingKind::number; }
  /// Such as "a whole number of at least 1", "one of stop, ignore".
  std::string expected() const;
  /// Of a choice, as one of `choices`. Throws std::invalid_argument with expected().
  SettingValue choice(std::string_view text) const;

 private:
  template <class T>
  void take_kind(const T& example) {
    if constexpr (std::is_enum_v<T>) {
      kind = SettingKind::choice;
      for (const T one : all_of(T{})) choices.push_back(name_of(one));
    } else if constexpr (requires { example.has_value(); }) {
      is_optional = true;
      take_kind(typename T::value_type());
    } else {
      kind = std::is_same_v<T, bool> ? SettingKind::flag
             : std::is_integral_v<T> ? SettingKind::whole
                                     : SettingKind::number;
    }
  }
};

/// Each setting of the list, in its order.
template <class Settings>
std::vector<SettingRef> setting_refs(Settings& settings) {
  std::vector<SettingRef> refs;
  visit_settings(settings,
                 [&](const Setting& setting, auto& value) { refs.emplace_back(setting, value); });
  return refs;
}

}  // namespace berth
