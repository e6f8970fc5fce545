#include "apps/berth/evaluation_options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "berth/files/number.hpp"
#include "berth/types/setting.hpp"

namespace berth::app {
namespace {

template <class T>
struct ValueOf {
  using Type = T;
};
template <class T>
struct ValueOf<std::optional<T>> {
  using Type = T;
};

template <class Enum>
std::vector<std::string> names_of() {
  std::vector<std::string> names;
  for (const Enum one : all_of(Enum{})) names.emplace_back(name_of(one));
  return names;
}

/// Throws std::invalid_argument with what was expected.
template <class T>
T parse(const Setting& setting, const std::string& text) {
  const auto number = [&](auto value) {
    if (value && setting.domain.holds(*value)) return *value;
    throw std::invalid_argument(
        fmt::format("{} is not {}", text, setting.domain.text(std::is_same_v<T, int>)));
  };
  if constexpr (std::is_same_v<T, bool>) {
    return text == "on";
  } else if constexpr (std::is_same_v<T, int>) {
    return number(parse_integer(text));
  } else if constexpr (std::is_same_v<T, double>) {
    return number(parse_finite(text));
  } else {
    const auto& all = all_of(T{});
    return *std::find_if(all.begin(), all.end(), [&](T one) { return name_of(one) == text; });
  }
}

template <class T>
std::string default_text(const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return value ? "on" : "off";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return fmt::format("{}", value);
  } else if constexpr (std::is_enum_v<T>) {
    return std::string(name_of(value));
  } else {
    return "none";
  }
}

/// The setting's name as an option.
std::string option_of(std::string_view name) {
  if (name == "range_m") return "--range";
  std::string option = "--" + std::string(name);
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

/// The unit that the name ends in.
std::string unit_of(std::string_view name) {
  const std::string_view end = name.substr(name.rfind('_') + 1);
  return end == "m" ? "M" : end == "px" ? "PX" : end == "us" ? "US" : "N";
}

void add_setting(CLI::App& command, const Setting& setting, std::string_view methods,
                 const auto& value, EvaluationArguments& arguments) {
  using T = typename ValueOf<std::remove_cvref_t<decltype(value)>>::Type;
  std::string what(setting.sentence);
  what = methods.empty() ? fmt::format("{}{}", char(std::toupper(what[0])), what.substr(1))
                         : fmt::format("{}: {}", methods, what);
  CLI::Option* option = command.add_option_function<std::string>(
      option_of(setting.name),
      [&arguments, name = std::string(setting.name)](const std::string& text) {
        arguments.given[name] = text;
      },
      fmt::format("{} (default: {})", what, default_text(value)));
  if constexpr (std::is_same_v<T, bool>) {
    option->check(CLI::IsMember({"on", "off"}));
  } else if constexpr (std::is_enum_v<T>) {
    option->check(CLI::IsMember(names_of<T>()));
  } else {
    option->type_name(unit_of(setting.name))->check([setting](const std::string& text) {
      try {
        parse<T>(setting, text);
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
template <class T>
void take_given(const EvaluationArguments& arguments, const Setting& setting, T& value) {
  const auto text = arguments.given.find(setting.name);
  if (text != arguments.given.end()) {
    value = parse<typename ValueOf<T>::Type>(setting, text->second);
  }
}

}  // namespace

void add_evaluation(CLI::App& command, EvaluationArguments& arguments) {
  const DistanceSettings defaults;
  visit_settings(defaults, [&](const Setting& setting, const auto& value) {
    add_setting(command, setting, "", value, arguments);
  });
  command
      .add_option_function<std::string>(
          "--visibility",
          [&arguments](const std::string& value) { arguments.visibility = value == "on"; },
          "Whether to give how much of each link and of the space around its answer the camera "
          "sees (default: on)")
      ->check(CLI::IsMember({"on", "off"}));
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
    add_setting(command, setting, setting.methods, value, arguments);
  });
}

EvaluationSettings EvaluationArguments::over(EvaluationSettings settings) const {
  settings.visibility = visibility.value_or(settings.visibility);
  visit_settings(settings.distance, [this](const Setting& setting, auto& value) {
    take_given(*this, setting, value);
  });
  validate(settings.distance);
  return settings;
}

ImageDistanceSettings EvaluationArguments::over(ImageDistanceSettings settings,
                                                Method method) const {
  visit_settings(settings, [&](const MethodSetting& setting, auto& value) {
    if (given.contains(setting.name)) require_method(setting, method);
    take_given(*this, setting, value);
  });
  validate(settings);
  return settings;
}

}  // namespace berth::app
