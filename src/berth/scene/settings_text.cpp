#include "berth/scene/settings_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <stdexcept>

#include "berth/types/setting.hpp"

namespace berth {
namespace {

std::string number_text(double value) {
  return std::isinf(value) ? "no limit" : fmt::format("{}", value);
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

std::string standing(const SettingValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* count = std::get_if<int>(&value)) return number_text(*count);
  if (const auto* number = std::get_if<double>(&value)) return number_text(*number);
  if (const auto* name = std::get_if<std::string_view>(&value)) return fmt::format("`{}`", *name);
  return "none";
}

std::string possible(const SettingRef& setting) {
  if (setting.kind == SettingKind::flag) return "true, false";
  if (setting.kind == SettingKind::choice) {
    return fmt::format("`{}`", fmt::join(setting.choices, "`, `"));
  }
  return (setting.kind == SettingKind::whole ? "whole, " : "") + domain_text(setting.domain);
}

}  // namespace

std::string settings_table(std::string_view group) {
  std::string table = "| key | default | may be | what it does |\n| --- | --- | --- | --- |\n";
  bool is_known = false;
  visit_scene_groups([&](std::string_view name, const auto& settings) {
    if (name != group) return;
    is_known = true;
    for (const SettingRef& setting : setting_refs(settings)) {
      table += fmt::format("| `{}` | {} | {} | {} |\n", setting.name, standing(setting.value),
                           possible(setting), setting.sentence);
    }
  });
  if (!is_known) {
    throw std::invalid_argument(fmt::format("settings group: \"{}\"; expected one of {}", group,
                                            fmt::join(kSettingGroups, ", ")));
  }
  return table;
}

}  // namespace berth
