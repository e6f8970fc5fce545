#include "setting_parameters.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace berth_ros {
namespace {

using berth::SettingKind, berth::SettingRef, berth::SettingValue;

/// A number that was written without a point is one too.
double number_of(const rclcpp::ParameterValue& value) {
  const bool is_whole = value.get_type() == rclcpp::ParameterType::PARAMETER_INTEGER;
  return is_whole ? static_cast<double>(value.get<std::int64_t>()) : value.get<double>();
}

std::string name_of(const std::string& group, const SettingRef& setting) {
  return group + "." + std::string(setting.name);
}

void declare(SettingNode& node, const std::string& name, const rclcpp::ParameterValue& value,
             const rcl_interfaces::msg::ParameterDescriptor& descriptor, GivenParameters& given) {
  const rclcpp::ParameterValue now = node.declare_parameter(name, value, descriptor);
  if (node.get_node_parameters_interface()->get_parameter_overrides().count(name) > 0) {
    given[name] = now;
  }
}

}  // namespace

rclcpp::ParameterValue parameter_of(const SettingRef& setting) {
  const SettingValue& value = setting.value;
  if (const auto* flag = std::get_if<bool>(&value)) return rclcpp::ParameterValue(*flag);
  if (const auto* count = std::get_if<int>(&value)) return rclcpp::ParameterValue(*count);
  if (const auto* number = std::get_if<double>(&value)) return rclcpp::ParameterValue(*number);
  if (const auto* name = std::get_if<std::string_view>(&value)) {
    return rclcpp::ParameterValue(std::string(*name));
  }
  return setting.kind == SettingKind::choice
             ? rclcpp::ParameterValue(std::string())
             : rclcpp::ParameterValue(std::numeric_limits<double>::quiet_NaN());
}

SettingValue value_from(const std::string& name, const rclcpp::ParameterValue& value,
                        const SettingRef& setting) {
  switch (setting.kind) {
    case SettingKind::flag:
      return value.get<bool>();
    case SettingKind::whole:
      return static_cast<int>(value.get<std::int64_t>());
    case SettingKind::number: {
      const double number = number_of(value);
      return setting.is_optional && std::isnan(number) ? SettingValue() : number;
    }
    case SettingKind::choice:
      break;
  }
  const std::string text = value.get<std::string>();
  if (setting.is_optional && text.empty()) return {};
  try {
    return setting.choice(text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name + ": " + error.what());
  }
}

rcl_interfaces::msg::ParameterDescriptor descriptor_of(const SettingRef& setting) {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description = setting.sentence;
  const berth::Domain& domain = setting.domain;
  // 0 lies below the least where it turns a rule off; validation knows the gap.
  const double least = domain.has_off ? 0.0 : domain.least;
  const bool is_choice = setting.kind == SettingKind::choice;
  if (is_choice || setting.kind == SettingKind::number) {
    descriptor.additional_constraints = setting.expected();
  }
  if (setting.is_optional) {
    // No range, since NaN, which stands for none, would be refused.
    descriptor.additional_constraints += is_choice ? ", or empty for none" : ", or NaN for none";
  } else if (setting.kind == SettingKind::whole) {
    descriptor.integer_range.resize(1);  // Humble's emplace_back() gives a copy
    auto& range = descriptor.integer_range.front();
    range.from_value = static_cast<std::int64_t>(least);
    range.to_value = domain.most < 1e9 ? static_cast<std::int64_t>(domain.most)
                                       : std::numeric_limits<int>::max();
  } else if (setting.kind == SettingKind::number) {
    descriptor.floating_point_range.resize(1);  // Humble's emplace_back() gives a copy
    auto& range = descriptor.floating_point_range.front();
    range.from_value = least;
    range.to_value = domain.most;
  }
  return descriptor;
}

void declare_settings(SettingNode& node, const std::string& group,
                      const std::vector<SettingRef>& settings, GivenParameters& given) {
  for (const SettingRef& setting : settings) {
    declare(node, name_of(group, setting), parameter_of(setting), descriptor_of(setting), given);
  }
}

void declare_own_settings(SettingNode& node, const std::string& group,
                          const std::vector<SettingRef>& settings, GivenParameters& given) {
  for (const SettingRef& setting : settings) {
    auto descriptor = descriptor_of(setting);
    descriptor.description += "; not set: as for all cameras";
    descriptor.dynamic_typing = true;
    declare(node, name_of(group, setting), {}, descriptor, given);
  }
}

void apply_given(const GivenParameters& given, const std::string& group,
                 const std::vector<SettingRef>& settings) {
  for (const SettingRef& setting : settings) {
    const std::string name = name_of(group, setting);
    const auto found = given.find(name);
    const bool is_set = found != given.end() &&
                        found->second.get_type() != rclcpp::ParameterType::PARAMETER_NOT_SET;
    if (is_set) setting.set(value_from(name, found->second, setting));
  }
}

}  // namespace berth_ros
