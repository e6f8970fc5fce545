// A setting is written once: in its struct, and in visit_settings() beside it, which reports its
// name, domain and one sentence. Validation, scene files, the command line and its help, and the
// tables in the documents are made from that. The name ends in the unit (_m, _px, _s, _us).
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

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

}  // namespace berth
