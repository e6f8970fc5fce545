#include "berth/robot/joint_trajectory.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
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
  std::vector<std::size_t> columns;
  for (const std::string& name : known) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw std::runtime_error(
          fmt::format("{}: joint \"{}\" of robot \"{}\" is missing; expected a column of this name "
                      "(the columns are {}), or, if it never moves, an entry in the scene's "
                      "fixed_joints",
                      source, name, model.name, fmt::join(names, ", ")));
    }
    columns.push_back(found - names.begin());
  }
  return columns;
}

std::string_view unit_of(const MovableJoint& joint) {
  return joint.type == JointType::prismatic ? "m" : "rad";
}

bool is_same_place(const JointState& a, const JointState& b) {
  constexpr double kStill = 0.02;  // rad or m
  return std::ranges::equal(a.position, b.position,
                            [](double x, double y) { return std::abs(x - y) <= kStill; });
}

/// A hand's breadth of the arm: less is noise, or stamps that jitter.
double least_jump(const MovableJoint& joint) {
  return joint.type == JointType::prismatic ? 0.05 : 0.1;
}

/// Where the URDF says nothing, faster than any arm.
double fastest(const MovableJoint& joint) {
  constexpr double kTimesItsLimit = 3;
  if (joint.max_speed > 0) return kTimesItsLimit * joint.max_speed;
  return joint.type == JointType::prismatic ? 10 : 30;
}

}  // namespace

JointTrajectory::JointTrajectory(const RobotModel& model, std::string source,
                                 const std::vector<std::string>& names,
                                 const std::vector<Sample>& samples)
    : source_(std::move(source)) {
  const std::vector<std::size_t> columns = columns_of(model, source_, names);
  for (const MovableJoint& joint : model.joints)
    is_continuous_.push_back(joint.type == JointType::continuous);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_used =
        std::ranges::find(columns, i) != columns.end() ||
        std::ranges::find(model.mimic_joints, names[i]) != model.mimic_joints.end();
    if (!is_used) unused_.push_back(names[i]);
  }
  for (const Sample& sample : samples) {
    JointState state{sample.time_s, {}};
    for (const std::size_t column : columns) state.position.push_back(sample.positions.at(column));
    states_.push_back(std::move(state));
  }
}

FrameTime JointTrajectory::at(double time_s, const JointTimeLimits& limits,
                              JointState& joints) const {
  const FrameTime time = joints_at_time(states_, is_continuous_, time_s, limits, joints);
  if (time.status != TimeStatus::skewed || moves_at(time_s)) return time;
  return joints_at_time(states_, is_continuous_, time_s, kOnlyBetweenSamples, joints);
}

bool JointTrajectory::moves_at(double time_s) const {
  const auto after = std::ranges::lower_bound(states_, time_s, {}, &JointState::stamp_s);
  if (after == states_.begin() || after == states_.end()) return true;
  return !is_same_place(*(after - 1), *after);
}

bool JointTrajectory::stands_still() const {
  return std::ranges::all_of(
      states_, [&](const JointState& state) { return is_same_place(states_.front(), state); });
}

std::string JointTrajectory::jump_of(const MovableJoint& joint, std::size_t i) const {
  for (std::size_t k = 1; k < states_.size(); ++k) {
    const JointState &a = states_[k - 1], &b = states_[k];
    const double time_s = b.stamp_s - a.stamp_s;
    const double way =
        joint_between(a.position[i], b.position[i], 1, is_continuous_[i]) - a.position[i];
    if (std::abs(way) < least_jump(joint) || std::abs(way) / time_s <= fastest(joint)) continue;
    return fmt::format(
        "{}: joint {} jumps from {:.4g} to {:.4g} {} within {:.4g} s, at {:.4g} s; expected {:.4g} "
        "{}/s at most. Do two nodes publish it?",
        source_, joint.name, a.position[i], b.position[i], unit_of(joint), time_s, b.stamp_s,
        fastest(joint), unit_of(joint));
  }
  return {};
}

std::vector<std::string> JointTrajectory::doubts(const RobotModel& model) const {
  std::vector<std::string> all;
  if (!unused_.empty()) {
    all.push_back(fmt::format("{}: not used: {}; robot {} has no movable joint of that name",
                              source_, fmt::join(unused_, ", "), model.name));
  }
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const MovableJoint& joint = model.joints[i];
    if (const std::string jump = jump_of(joint, i); !jump.empty()) all.push_back(jump);
    const auto is_outside = [&](const JointState& state) {
      if (joint.lower >= joint.upper) return false;
      return state.position[i] < joint.lower - least_jump(joint) ||
             state.position[i] > joint.upper + least_jump(joint);
    };
    const auto outside = std::ranges::find_if(states_, is_outside);
    if (outside == states_.end()) continue;
    all.push_back(
        fmt::format("{}: joint {} is at {:.4g} {}, at {:.4g} s; its limits are {:.4g} to {:.4g}",
                    source_, joint.name, outside->position[i], unit_of(joint), outside->stamp_s,
                    joint.lower, joint.upper));
  }
  return all;
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

}  // namespace berth
