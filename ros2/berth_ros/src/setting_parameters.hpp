// berth's settings as ROS parameters.
#pragma once

#include <map>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <string>
#include <vector>

#include "berth/types/setting.hpp"

namespace berth_ros {

/// The nodes that have settings.
using SettingNode = rclcpp_lifecycle::LifecycleNode;

/// The parameters that somebody gave, by name: at the start or later. All others are at their
/// defaults, and a scene file may say otherwise.
using GivenParameters = std::map<std::string, rclcpp::ParameterValue>;

/// A setting's value as a parameter: an optional one that is not set is NaN, or an empty text.
rclcpp::ParameterValue parameter_of(const berth::SettingRef& setting);

/// The other way. Throws std::invalid_argument for a name that there is not, and
/// rclcpp::ParameterTypeException for a value of another type.
berth::SettingValue value_from(const std::string& name, const rclcpp::ParameterValue& value,
                               const berth::SettingRef& setting);

/// What `ros2 param describe` says of a setting.
rcl_interfaces::msg::ParameterDescriptor descriptor_of(const berth::SettingRef& setting);

/// Declares `group`.NAME for each setting.
void declare_settings(SettingNode& node, const std::string& group,
                      const std::vector<berth::SettingRef>& settings, GivenParameters& given);

/// The same for what a single camera overrides: not set, where that of all cameras counts.
void declare_own_settings(SettingNode& node, const std::string& group,
                          const std::vector<berth::SettingRef>& settings, GivenParameters& given);

/// Puts what was given over the settings. Throws as value_from does.
void apply_given(const GivenParameters& given, const std::string& group,
                 const std::vector<berth::SettingRef>& settings);

}  // namespace berth_ros
