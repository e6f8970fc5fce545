// berth's lists of settings (visit_settings) as ROS parameters.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "berth/types/setting.hpp"

namespace berth_ros {

/// The nodes that have settings.
using SettingNode = rclcpp_lifecycle::LifecycleNode;

/// The parameters that somebody gave, by name: at the start or later. All others are at their
/// defaults, and a scene file may say otherwise.
using GivenParameters = std::map<std::string, rclcpp::ParameterValue>;

/// A setting's default as a parameter: an optional one that is not set is NaN, or an empty text.
template <class T>
rclcpp::ParameterValue parameter_of(const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return rclcpp::ParameterValue(value);
  } else if constexpr (std::is_enum_v<T>) {
    return rclcpp::ParameterValue(std::string(name_of(value)));
  } else if constexpr (std::is_integral_v<T>) {
    return rclcpp::ParameterValue(static_cast<std::int64_t>(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    return rclcpp::ParameterValue(static_cast<double>(value));
  } else if constexpr (std::is_enum_v<typename T::value_type>) {
    return value ? parameter_of(*value) : rclcpp::ParameterValue(std::string());
  } else {
    return value ? parameter_of(*value)
                 : rclcpp::ParameterValue(std::numeric_limits<double>::quiet_NaN());
  }
}

/// A number that was written without a point is one too.
inline double number_of(const rclcpp::ParameterValue& value) {
  const bool is_whole = value.get_type() == rclcpp::ParameterType::PARAMETER_INTEGER;
  return is_whole ? static_cast<double>(value.get<std::int64_t>()) : value.get<double>();
}

/// The other way. Throws std::invalid_argument for a name that no enumerator has, and
/// rclcpp::ParameterTypeException for a value of another type.
template <class T>
void assign_parameter(const std::string& name, const rclcpp::ParameterValue& value, T& out) {
  if constexpr (std::is_same_v<T, bool>) {
    out = value.get<bool>();
  } else if constexpr (std::is_enum_v<T>) {
    const std::string text = value.get<std::string>();
    std::string known;
    for (const T one : all_of(T{})) {
      if (name_of(one) == text) {
        out = one;
        return;
      }
      known += (known.empty() ? "" : ", ") + std::string(name_of(one));
    }
    throw std::invalid_argument(name + ": \"" + text + "\"; expected one of " + known);
  } else if constexpr (std::is_integral_v<T>) {
    out = static_cast<T>(value.get<std::int64_t>());
  } else if constexpr (std::is_floating_point_v<T>) {
    out = number_of(value);
  } else if constexpr (std::is_enum_v<typename T::value_type>) {
    if (value.get<std::string>().empty()) {
      out.reset();
    } else {
      assign_parameter(name, value, out.emplace());
    }
  } else if (std::isnan(number_of(value))) {
    out.reset();
  } else {
    assign_parameter(name, value, out.emplace());
  }
}

/// What `ros2 param describe` says of a setting.
template <class T>
rcl_interfaces::msg::ParameterDescriptor descriptor_of(const berth::Setting& setting, const T&) {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description = setting.sentence;
  // 0 lies below the least where it turns a rule off; validation knows the gap.
  const double least = setting.domain.has_off ? 0.0 : setting.domain.least;
  if constexpr (std::is_same_v<T, bool>) {
  } else if constexpr (std::is_enum_v<T>) {
    for (const T one : all_of(T{})) {
      descriptor.additional_constraints +=
          (descriptor.additional_constraints.empty() ? "one of " : ", ") +
          std::string(name_of(one));
    }
  } else if constexpr (std::is_integral_v<T>) {
    descriptor.integer_range.resize(1);  // Humble's emplace_back() gives a copy
    auto& range = descriptor.integer_range.front();
    range.from_value = static_cast<std::int64_t>(least);
    range.to_value = setting.domain.most < 1e9 ? static_cast<std::int64_t>(setting.domain.most)
                                               : std::numeric_limits<int>::max();
  } else if constexpr (std::is_floating_point_v<T>) {
    descriptor.floating_point_range.resize(1);  // Humble's emplace_back() gives a copy
    auto& range = descriptor.floating_point_range.front();
    range.from_value = least;
    range.to_value = setting.domain.most;
    descriptor.additional_constraints = setting.domain.text(false);
  } else if constexpr (std::is_enum_v<typename T::value_type>) {
    descriptor = descriptor_of(setting, typename T::value_type{});
    descriptor.additional_constraints += ", or empty for none";
  } else {
    // No range, since NaN, which stands for none, would be refused.
    descriptor.additional_constraints = setting.domain.text(false) + ", or NaN for none";
  }
  return descriptor;
}

/// Declares `group`.NAME for each setting.
template <class Settings>
void declare_settings(SettingNode& node, const std::string& group, const Settings& defaults,
                      GivenParameters& given) {
  const auto& overrides = node.get_node_parameters_interface()->get_parameter_overrides();
  visit_settings(defaults, [&](const berth::Setting& setting, const auto& value) {
    const std::string name = group + "." + std::string(setting.name);
    const rclcpp::ParameterValue now =
        node.declare_parameter(name, parameter_of(value), descriptor_of(setting, value));
    if (overrides.count(name) > 0) given[name] = now;
  });
}

/// The same for what a single camera overrides: not set, where that of all cameras counts.
template <class Settings>
void declare_own_settings(SettingNode& node, const std::string& group, const Settings& defaults,
                          GivenParameters& given) {
  const auto& overrides = node.get_node_parameters_interface()->get_parameter_overrides();
  visit_settings(defaults, [&](const berth::Setting& setting, const auto& value) {
    const std::string name = group + "." + std::string(setting.name);
    auto descriptor = descriptor_of(setting, value);
    descriptor.description += "; not set: as for all cameras";
    descriptor.dynamic_typing = true;
    const rclcpp::ParameterValue now =
        node.declare_parameter(name, rclcpp::ParameterValue(), descriptor);
    if (overrides.count(name) > 0) given[name] = now;
  });
}

/// Puts what was given over `settings`. Throws as assign_parameter does.
template <class Settings>
void apply_given(const GivenParameters& given, const std::string& group, Settings& settings) {
  visit_settings(settings, [&](const berth::Setting& setting, auto& value) {
    const std::string name = group + "." + std::string(setting.name);
    const auto found = given.find(name);
    const bool is_set = found != given.end() &&
                        found->second.get_type() != rclcpp::ParameterType::PARAMETER_NOT_SET;
    if (is_set) assign_parameter(name, found->second, value);
  });
}

}  // namespace berth_ros
