#include "berth/robot/other_robots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace berth {
namespace {

/// The names that begin with the prefix, without it.
std::vector<std::string> without_prefix(const std::vector<std::string>& names,
                                        const std::string& prefix) {
  std::vector<std::string> own;
  for (const std::string& name : names) {
    if (name.starts_with(prefix)) own.push_back(name.substr(prefix.size()));
  }
  return own;
}

RobotSettings settings_of(const OtherRobot& other, const RobotSettings& settings) {
  RobotSettings own;
  own.urdf = other.urdf;
  own.package_paths = other.package_paths;
  own.geometry = settings.geometry;
  own.environment_links = without_prefix(settings.environment_links, other.prefix);
  own.ignore_links = without_prefix(settings.ignore_links, other.prefix);
  own.guarded_links = without_prefix(settings.guarded_links, other.prefix);
  return own;
}

bool has_joint(const RobotModel& model, const std::string& name) {
  return std::ranges::find(model.joints, name, &MovableJoint::name) != model.joints.end();
}

void append(const OtherRobot& other, RobotModel loaded, RobotModel& model) {
  const auto fail = [&](const std::string& what) {
    throw std::runtime_error(fmt::format("{}: others: {}", other.urdf.string(), what));
  };
  const auto parent = model.find_link(other.parent);
  if (!parent)
    fail(fmt::format("no link \"{}\" to stand on; expected one that there is", other.parent));
  const std::size_t links = model.links.size(), joints = model.joints.size();
  for (Link& link : loaded.links) {
    link.name = other.prefix + link.name;
    if (model.find_link(link.name)) {
      fail(fmt::format("a second link \"{}\"; expected names that differ (prefix)", link.name));
    }
    link.joint.name = other.prefix + (link.parent ? link.joint.name : "mount");
    if (!link.parent) link.joint.X_PJ = other.X_PR;
    link.parent = link.parent ? links + *link.parent : *parent;
    if (link.joint.position_index) *link.joint.position_index += joints;
    model.links.push_back(std::move(link));
  }
  for (MovableJoint& joint : loaded.joints) {
    joint.name = other.prefix + joint.name;
    if (has_joint(model, joint.name)) {
      fail(fmt::format("a second joint \"{}\"; expected names that differ (prefix)", joint.name));
    }
    model.joints.push_back(std::move(joint));
  }
  for (const std::string& name : loaded.mimic_joints) {
    model.mimic_joints.push_back(other.prefix + name);
  }
  model.warnings.insert(model.warnings.end(), loaded.warnings.begin(), loaded.warnings.end());
}

}  // namespace

void append_other_robots(const RobotSettings& settings, RobotModel& model) {
  for (const OtherRobot& other : settings.others) {
    append(other, load_one_robot(settings_of(other, settings)), model);
  }
}

}  // namespace berth
