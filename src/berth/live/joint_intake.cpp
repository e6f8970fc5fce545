#include "berth/live/joint_intake.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace berth {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();
/// Of one joint; who waits longer for another joint loses its oldest.
constexpr std::size_t kMostWaiting = 1000;

double value_of(const std::map<std::string, double>& values, const std::string& joint,
                double otherwise) {
  const auto found = values.find(joint);
  return found == values.end() ? otherwise : found->second;
}

void require_joints(const std::vector<std::string>& names, std::string_view key,
                    const std::map<std::string, double>& values) {
  for (const auto& [joint, value] : values) {
    if (std::find(names.begin(), names.end(), joint) == names.end()) {
      throw std::invalid_argument(
          fmt::format("{}.{}: no joint of the robot that moves by itself", key, joint));
    }
    if (std::isfinite(value)) continue;
    throw std::invalid_argument(
        fmt::format("{}.{}: {}; expected a finite number", key, joint, value));
  }
}

}  // namespace

JointIntake::JointIntake(const RobotModel& model, JointIntakeSettings settings)
    : settings_(std::move(settings)), buffer_(model, settings_.capacity) {
  if (!(settings_.max_hold_s >= 0)) {
    throw std::invalid_argument(
        fmt::format("max_hold_s: {}; expected a number of at least 0", settings_.max_hold_s));
  }
  for (const MovableJoint& joint : model.joints) {
    names_.push_back(joint.name);
    is_continuous_.push_back(joint.type == JointType::continuous);
    const bool has_limits = joint.upper > joint.lower;
    const double beyond = joint.type == JointType::prismatic ? kBeyondLimit_m : kBeyondLimit_rad;
    least_.push_back(has_limits ? std::max(-kMostPosition, joint.lower - beyond) : -kMostPosition);
    most_.push_back(has_limits ? std::min(kMostPosition, joint.upper + beyond) : kMostPosition);
    offset_.push_back(value_of(settings_.offsets, joint.name, 0));
    fixed_.push_back(
        value_of(settings_.fixed, joint.name, std::numeric_limits<double>::quiet_NaN()));
  }
  require_joints(names_, "joint_offsets", settings_.offsets);
  require_joints(names_, "fixed_joints", settings_.fixed);
  nobody_tells_ =
      std::none_of(fixed_.begin(), fixed_.end(), [](double fixed) { return std::isnan(fixed); });
  whole_.resize(names_.size());
  restart();
}

void JointIntake::restart() {
  series_.assign(names_.size(), {});
  behind_ = {};
  buffer_.clear();
  emitted_s_ = kNever;
}

TimeStatus JointIntake::push(double stamp_s, std::span<const std::string> names,
                             std::span<const double> positions) {
  if (names.size() != positions.size()) {
    throw std::invalid_argument(
        fmt::format("joint message: {} names and {} positions; expected equally many", names.size(),
                    positions.size()));
  }
  if (!std::isfinite(stamp_s)) return TimeStatus::stamp_jumped;
  const std::lock_guard lock(mutex_);
  find_told(names, positions);
  if (told_.empty() && !nobody_tells_) return TimeStatus::missing_joint;
  if (is_set_back(stamp_s)) {
    restart();
    ++restarts_;
  }
  if (nobody_tells_) return buffer_.push(stamp_s, names_, fixed_);
  bool any_new = false;
  for (const Told& told : told_) any_new |= append(told.joint, stamp_s, told.position);
  if (!any_new) return TimeStatus::stamp_went_back;
  emit_whole_samples();
  return TimeStatus::ok;
}

bool JointIntake::is_set_back(double stamp_s) {
  bool is_back = nobody_tells_ && behind_.is_set_back(buffer_.newest_stamp_s() - stamp_s);
  for (const Told& told : told_) {
    Series& series = series_[told.joint];
    if (!series.is_empty()) is_back |= series.behind.is_set_back(series.stamp_s.back() - stamp_s);
  }
  return is_back;
}

void JointIntake::find_told(std::span<const std::string> names, std::span<const double> positions) {
  told_.clear();
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (!std::isnan(fixed_[i])) continue;
    const auto found = std::find(names.begin(), names.end(), names_[i]);
    if (found == names.end()) continue;
    const double position = positions[found - names.begin()] + offset_[i];
    require_possible(i, position);
    told_.push_back({i, position});
  }
}

void JointIntake::require_possible(std::size_t joint, double position) const {
  // So is NaN.
  if (position >= least_[joint] && position <= most_[joint]) return;
  throw std::invalid_argument(fmt::format("joint {}: {}; expected a number from {} to {}",
                                          names_[joint], position, least_[joint], most_[joint]));
}

bool JointIntake::append(std::size_t joint, double stamp_s, double position) {
  Series& series = series_[joint];
  if (!series.is_empty() && stamp_s <= series.stamp_s.back()) return false;
  if (series.stamp_s.size() == kMostWaiting) {
    series.stamp_s.erase(series.stamp_s.begin());
    series.position.erase(series.position.begin());
  }
  series.stamp_s.push_back(stamp_s);
  series.position.push_back(position);
  return true;
}

std::size_t JointIntake::slowest() const {
  std::size_t slowest = names_.size();
  double least_s = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (!std::isnan(fixed_[i])) continue;
    const double newest_s = series_[i].is_empty() ? kNever : series_[i].stamp_s.back();
    if (newest_s >= least_s) continue;
    least_s = newest_s;
    slowest = i;
  }
  return slowest;
}

std::string_view JointIntake::waiting_for() const {
  const std::lock_guard lock(mutex_);
  const std::size_t joint = slowest();
  if (joint == names_.size()) return {};
  if (series_[joint].is_empty()) return names_[joint];
  const double least_s = series_[joint].stamp_s.back();
  const bool others_are_newer = std::any_of(series_.begin(), series_.end(), [&](const Series& s) {
    return !s.is_empty() && s.stamp_s.back() > least_s;
  });
  return others_are_newer ? std::string_view(names_[joint]) : std::string_view{};
}

int JointIntake::restarts() const {
  const std::lock_guard lock(mutex_);
  return restarts_;
}

void JointIntake::emit_whole_samples() {
  const std::size_t last = slowest();
  if (series_[last].is_empty()) return;
  const double ready_s = series_[last].stamp_s.back() + settings_.max_hold_s;
  stamps_s_.clear();
  for (const Series& series : series_) {
    for (auto at = series.stamp_s.rbegin(); at != series.stamp_s.rend() && *at > emitted_s_; ++at) {
      if (*at <= ready_s) stamps_s_.push_back(*at);
    }
  }
  std::sort(stamps_s_.begin(), stamps_s_.end());
  stamps_s_.erase(std::unique(stamps_s_.begin(), stamps_s_.end()), stamps_s_.end());
  for (const double stamp_s : stamps_s_) {
    if (emit(stamp_s)) emitted_s_ = stamp_s;
  }
  drop_before(emitted_s_);
}

bool JointIntake::emit(double stamp_s) {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    whole_[i] = fixed_[i];
    if (!std::isnan(fixed_[i])) continue;
    const Series& series = series_[i];
    const auto after = std::lower_bound(series.stamp_s.begin(), series.stamp_s.end(), stamp_s);
    if (after == series.stamp_s.begin() && *after != stamp_s) return false;
    const auto k = after - series.stamp_s.begin();
    if (after == series.stamp_s.end()) {
      whole_[i] = series.position.back();
    } else if (*after == stamp_s) {
      whole_[i] = series.position[k];
    } else {
      const double share = (stamp_s - after[-1]) / (after[0] - after[-1]);
      whole_[i] =
          joint_between(series.position[k - 1], series.position[k], share, is_continuous_[i]);
    }
  }
  buffer_.push(stamp_s, names_, whole_);
  return true;
}

/// All but the last one before, which the next is interpolated from.
void JointIntake::drop_before(double stamp_s) {
  for (Series& series : series_) {
    const auto after = std::upper_bound(series.stamp_s.begin(), series.stamp_s.end(), stamp_s);
    const auto dropped = after - series.stamp_s.begin() - 1;
    if (dropped <= 0) continue;
    series.stamp_s.erase(series.stamp_s.begin(), series.stamp_s.begin() + dropped);
    series.position.erase(series.position.begin(), series.position.begin() + dropped);
  }
}

}  // namespace berth
