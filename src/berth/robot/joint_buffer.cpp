#include "berth/robot/joint_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace berth {

JointBuffer::JointBuffer(const RobotModel& model, std::size_t capacity) : capacity_(capacity) {
  if (capacity < 2) throw std::invalid_argument("joint buffer: capacity; expected 2 at least");
  for (const MovableJoint& joint : model.joints) {
    names_.push_back(joint.name);
    is_continuous_.push_back(joint.type == JointType::continuous);
  }
  samples_.reserve(capacity);
  incoming_.resize(names_.size());
}

TimeStatus JointBuffer::push(double stamp_s, std::span<const std::string> names,
                             std::span<const double> positions) {
  if (names.size() != positions.size()) {
    throw std::invalid_argument("joint sample: names and positions; expected equally many");
  }
  const std::lock_guard lock(mutex_);
  missing_ = {};
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const auto found = std::find(names.begin(), names.end(), names_[i]);
    if (found != names.end()) incoming_[i] = positions[found - names.begin()];
    if (found == names.end() || !std::isfinite(incoming_[i])) {
      missing_ = names_[i];
      return TimeStatus::missing_joint;
    }
  }
  if (!std::isfinite(stamp_s)) return TimeStatus::stamp_jumped;
  if (!samples_.empty() && stamp_s <= samples_.back().stamp_s) return TimeStatus::stamp_went_back;
  keep(stamp_s);
  return TimeStatus::ok;
}

void JointBuffer::keep(double stamp_s) {
  if (samples_.size() < capacity_) {
    samples_.push_back({stamp_s, incoming_});
    return;
  }
  std::rotate(samples_.begin(), samples_.begin() + 1, samples_.end());
  samples_.back().stamp_s = stamp_s;
  samples_.back().position = incoming_;
}

FrameTime JointBuffer::at(double time_s, const JointTimeLimits& limits, JointState& joints) const {
  const std::lock_guard lock(mutex_);
  FrameTime time = joints_at_time(samples_, is_continuous_, time_s, limits, joints);
  const bool after_newest = samples_.empty() || time_s > samples_.back().stamp_s;
  if (time.status != TimeStatus::ok && after_newest && !missing_.empty()) {
    time.status = TimeStatus::missing_joint;
  }
  return time;
}

TimeStatus JointBuffer::newest(JointState& joints) const {
  const std::lock_guard lock(mutex_);
  if (!samples_.empty() && missing_.empty()) {
    joints = samples_.back();
    return TimeStatus::ok;
  }
  joints.stamp_s = std::numeric_limits<double>::quiet_NaN();
  joints.position.assign(names_.size(), std::numeric_limits<double>::quiet_NaN());
  return missing_.empty() ? TimeStatus::no_joints : TimeStatus::missing_joint;
}

TimeStatus JointBuffer::velocity(double window_s, std::vector<double>& velocity) const {
  const std::lock_guard lock(mutex_);
  velocity.assign(names_.size(), std::numeric_limits<double>::quiet_NaN());
  if (!missing_.empty()) return TimeStatus::missing_joint;
  if (samples_.size() < 2) return TimeStatus::no_joints;
  const JointState& newest = samples_.back();
  auto before = samples_.end() - 2;
  while (before != samples_.begin() && newest.stamp_s - before->stamp_s < window_s) --before;
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const double way =
        joint_between(before->position[i], newest.position[i], 1, is_continuous_[i]) -
        before->position[i];
    velocity[i] = way / (newest.stamp_s - before->stamp_s);
  }
  return TimeStatus::ok;
}

double JointBuffer::newest_stamp_s() const {
  const std::lock_guard lock(mutex_);
  return samples_.empty() ? std::numeric_limits<double>::quiet_NaN() : samples_.back().stamp_s;
}

std::string JointBuffer::missing_joint() const {
  const std::lock_guard lock(mutex_);
  return std::string(missing_);
}

void JointBuffer::clear() {
  const std::lock_guard lock(mutex_);
  samples_.clear();
  missing_ = {};
}

}  // namespace berth
