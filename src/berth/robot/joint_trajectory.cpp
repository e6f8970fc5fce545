#include "berth/robot/joint_trajectory.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace berth {
namespace {

std::vector<std::string> names_of(const std::vector<MovableJoint>& joints) {
  std::vector<std::string> names;
  for (const MovableJoint& joint : joints) names.push_back(joint.name);
  return names;
}

/// The column of each of the robot's joints.
std::vector<std::size_t> columns_of(const RobotModel& model, const std::string& source,
                                    const std::vector<std::string>& names) {
  const std::vector<std::string> known = names_of(model.joints);
  const auto contains = [](const auto& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  for (const std::string& name : names) {
    if (contains(known, name) || contains(model.mimic_joints, name)) continue;
    throw std::runtime_error(
        fmt::format("{}: \"{}\" is no joint of robot \"{}\" that moves; expected {}", source, name,
                    model.name, fmt::join(known, ", ")));
  }
  std::vector<std::size_t> columns;
  for (const std::string& name : known) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw std::runtime_error(
          fmt::format("{}: joint \"{}\" of robot \"{}\" is missing; expected a column, or a fixed "
                      "position, for each of {}",
                      source, name, model.name, fmt::join(known, ", ")));
    }
    columns.push_back(found - names.begin());
  }
  return columns;
}

}  // namespace

JointTrajectory::JointTrajectory(const RobotModel& model, std::string source,
                                 const std::vector<std::string>& names,
                                 const std::vector<Sample>& samples)
    : source_(std::move(source)) {
  const std::vector<std::size_t> columns = columns_of(model, source_, names);
  for (const MovableJoint& joint : model.joints)
    is_continuous_.push_back(joint.type == JointType::continuous);
  for (const Sample& sample : samples) {
    JointState state{sample.time_s, {}};
    for (const std::size_t column : columns) state.position.push_back(sample.positions.at(column));
    states_.push_back(std::move(state));
  }
}

FrameTime JointTrajectory::at(double time_s, const JointTimeLimits& limits,
                              JointState& joints) const {
  return joints_at_time(states_, is_continuous_, time_s, limits, joints);
}

void JointTrajectory::velocity(double time_s, std::vector<double>& velocity) const {
  velocity.assign(is_continuous_.size(), std::numeric_limits<double>::quiet_NaN());
  if (states_.size() < 2 || !(time_s >= first_s() && time_s <= last_s())) return;
  const auto after = std::max(states_.begin() + 1,
                              std::ranges::lower_bound(states_, time_s, {}, &JointState::stamp_s));
  const JointState &a = *(after - 1), &b = *after;
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const double way =
        joint_between(a.position[i], b.position[i], 1, is_continuous_[i]) - a.position[i];
    velocity[i] = way / (b.stamp_s - a.stamp_s);
  }
}

const JointState& JointTrajectory::sample(std::size_t index) const {
  if (index < states_.size()) return states_[index];
  throw std::runtime_error(
      fmt::format("{}: {} rows of joint angles, but frame {} needs row {} (a frame without a stamp "
                  "takes the row of its "
                  "number)",
                  source_, states_.size(), index, index));
}

}  // namespace berth
