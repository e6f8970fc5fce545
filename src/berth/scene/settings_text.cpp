#include "berth/scene/settings_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace berth {
namespace {

std::string number_text(double value) {
  return std::isinf(value) ? "no limit" : fmt::format("{}", value);
}

template <class Enum>
std::string names_text() {
  std::vector<std::string> names;
  for (const Enum one : all_of(Enum{})) names.push_back(fmt::format("`{}`", name_of(one)));
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Such as "above 0", "1 to 64", "0, or 1 and more".
std::string domain_text(const Domain& domain) {
  const bool has_most = std::isfinite(domain.most);
  std::string range;
  if (domain.is_open) {
    range = fmt::format("above {}", domain.least);
    if (has_most) range += fmt::format(", up to {}", domain.most);
  } else {
    range = has_most ? fmt::format("{} to {}", domain.least, domain.most)
                     : fmt::format("{} and more", domain.least);
  }
  return domain.has_off ? "0, or " + range : range;
}

template <class T>
struct ValueText {
  static std::string standing(const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      return value ? "true" : "false";
    } else if constexpr (std::is_enum_v<T>) {
      return fmt::format("`{}`", name_of(value));
    } else {
      return number_text(value);
    }
  }
  static std::string possible(const Domain& domain) {
    if constexpr (std::is_same_v<T, bool>) {
      return "true, false";
    } else if constexpr (std::is_enum_v<T>) {
      return names_text<T>();
    } else if constexpr (std::is_integral_v<T>) {
      return "whole, " + domain_text(domain);
    } else {
      return domain_text(domain);
    }
  }
};

template <class T>
struct ValueText<std::optional<T>> {
  static std::string standing(const std::optional<T>& value) {
    return value ? ValueText<T>::standing(*value) : "none";
  }
  static std::string possible(const Domain& domain) { return ValueText<T>::possible(domain); }
};

/// Writes one row for each setting that it visits.
struct TableWriter {
  std::string& table;

  template <class T>
  void operator()(const Setting& setting, const T& value) const {
    table += fmt::format("| `{}` | {} | {} | {} |\n", setting.name, ValueText<T>::standing(value),
                         ValueText<T>::possible(setting.domain), setting.sentence);
  }
};

}  // namespace

std::string settings_table(std::string_view group) {
  std::string table = "| key | default | may be | what it does |\n| --- | --- | --- | --- |\n";
  const TableWriter write{table};
  bool is_known = false;
  visit_scene_groups([&](std::string_view name, const auto& settings) {
    if (name != group) return;
    is_known = true;
    visit_settings(settings, write);
  });
  if (!is_known) {
    throw std::invalid_argument(fmt::format("settings group: \"{}\"; expected one of {}", group,
                                            fmt::join(kSettingGroups, ", ")));
  }
  return table;
}

}  // namespace berth
