#include "apps/berth/evaluation_options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <vector>

#include "berth/files/number.hpp"
#include "berth/types/setting.hpp"

namespace berth::app {
namespace {

template <class Enum>
std::vector<std::string> names_of() {
  std::vector<std::string> names;
  for (const Enum one : all_of(Enum{})) names.emplace_back(name_of(one));
  return names;
}

/// Throws std::invalid_argument with what was expected.
SettingValue parse(const SettingRef& setting, const std::string& text) {
  const auto checked = [&](auto number) {
    if (number && setting.domain.holds(*number)) return SettingValue(*number);
    throw std::invalid_argument(fmt::format("{} is not {}", text, setting.expected()));
  };
  if (setting.kind == SettingKind::flag) return text == "on";
  if (setting.kind == SettingKind::choice) return setting.choice(text);
  return setting.kind == SettingKind::whole ? checked(parse_integer(text))
                                            : checked(parse_finite(text));
}

std::string default_text(const SettingRef& setting) {
  if (setting.is_optional) return "none";
  if (const auto* flag = std::get_if<bool>(&setting.value)) return *flag ? "on" : "off";
  if (const auto* count = std::get_if<int>(&setting.value)) return fmt::format("{}", *count);
  if (const auto* number = std::get_if<double>(&setting.value)) return fmt::format("{}", *number);
  return std::string(std::get<std::string_view>(setting.value));
}

/// The setting's name as an option.
std::string option_of(std::string_view name) {
  std::string option = "--" + std::string(name);
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

/// All names of the option: programs rely on --range, too.
std::string options_of(std::string_view name) {
  return option_of(name) + (name == "range_m" ? ",--range" : "");
}

/// The unit that the name ends in.
std::string unit_of(std::string_view name) {
  const std::string_view end = name.substr(name.rfind('_') + 1);
  return end == "m" ? "M" : end == "px" ? "PX" : end == "us" ? "US" : "N";
}

void add_setting(CLI::App& command, const SettingRef& setting, std::string_view methods,
                 EvaluationArguments& arguments) {
  std::string what(setting.sentence);
  what = methods.empty() ? fmt::format("{}{}", char(std::toupper(what[0])), what.substr(1))
                         : fmt::format("{}: {}", methods, what);
  CLI::Option* option = command.add_option_function<std::string>(
      options_of(setting.name),
      [&arguments, name = std::string(setting.name)](const std::string& text) {
        arguments.given[name] = text;
      },
      fmt::format("{} (default: {})", what, default_text(setting)));
  if (setting.kind == SettingKind::flag) {
    option->check(CLI::IsMember({"on", "off"}));
  } else if (setting.kind == SettingKind::choice) {
    option->check(
        CLI::IsMember(std::vector<std::string>(setting.choices.begin(), setting.choices.end())));
  } else {
    option->type_name(unit_of(setting.name))->check([setting](const std::string& text) {
      try {
        parse(setting, text);
        return std::string();
      } catch (const std::invalid_argument& error) {
        return std::string(error.what());
      }
    });
  }
}

/// Whether the words hold this one.
bool has_word(std::string_view words, std::string_view word) {
  return fmt::format(" {} ", words).find(fmt::format(" {} ", word)) != std::string::npos;
}

/// Throws where a setting was given that belongs to other methods.
void require_method(const MethodSetting& setting, Method used) {
  if (setting.methods.empty() || has_word(setting.methods, name_of(used))) return;
  std::string expected(setting.methods);
  for (std::size_t at = 0; (at = expected.find(' ', at)) != std::string::npos; at += 4) {
    expected.replace(at, 1, " or ");
  }
  throw std::invalid_argument(fmt::format("method {}: has no {}; expected method {}", name_of(used),
                                          option_of(setting.name), expected));
}

/// Sets it if it was given.
void take_given(const EvaluationArguments& arguments, const SettingRef& setting) {
  const auto text = arguments.given.find(setting.name);
  if (text != arguments.given.end()) setting.set(parse(setting, text->second));
}

}  // namespace

void add_evaluation(CLI::App& command, EvaluationArguments& arguments) {
  const EvaluationSettings defaults;
  for (const SettingRef& setting : setting_refs(defaults)) {
    add_setting(command, setting, "", arguments);
  }
}

void add_methods(CLI::App& command, Method& method, EvaluationArguments& arguments) {
  command
      .add_option_function<std::string>(
          "--method",
          [&method](const std::string& name) { method = method_from_name(name).value(); },
          fmt::format("How to compare the images (default: {})", name_of(method)))
      ->check(CLI::IsMember(names_of<Method>()));
  const ImageDistanceSettings defaults;
  visit_settings(defaults, [&](const MethodSetting& setting, const auto& value) {
    add_setting(command, {setting, value}, setting.methods, arguments);
  });
}

EvaluationSettings EvaluationArguments::over(EvaluationSettings settings) const {
  for (const SettingRef& setting : setting_refs(settings)) take_given(*this, setting);
  validate(settings.distance);
  return settings;
}

ImageDistanceSettings EvaluationArguments::over(ImageDistanceSettings settings,
                                                Method method) const {
  visit_settings(settings, [&](const MethodSetting& setting, auto& value) {
    if (given.contains(setting.name)) require_method(setting, method);
    take_given(*this, {setting, value});
  });
  validate(settings);
  return settings;
}

}  // namespace berth::app
