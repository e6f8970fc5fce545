#include "velocity_commands.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "berth/results/result_text.hpp"
#include "berth/types/joint_state.hpp"

namespace berth_ros {
namespace {

double seconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

std::string in_ms(double time_s) { return std::to_string(std::lround(1e3 * time_s)) + " ms"; }

/// Such as "arm (occupied), hand (known)".
std::string held_by(const berth::FilteredVelocity& allowed, const berth::Result& result) {
  std::vector<std::string> rows;
  for (const berth::LinkRow& row : allowed.held_by) {
    rows.push_back(result.links[row.link - 1].link + " (" + std::string(name_of(row.kind)) + ")");
  }
  return joined(rows);
}

std::string trouble_of(const berth::FilteredVelocity& allowed, const berth::Result& result) {
  using berth::FilterStatus;
  if (allowed.status == FilterStatus::ok) return "";
  if (allowed.status == FilterStatus::stale) return berth::status_text(result);
  std::string text(name_of(allowed.status));
  if (allowed.status == FilterStatus::bad_joints) {
    text += ": position or velocity of a joint is not known";
  }
  if (!allowed.held_by.empty()) text += ": " + held_by(allowed, result);
  if (result.status != berth::ResultStatus::ok) text += ": " + berth::status_text(result);
  return text;
}

}  // namespace

VelocityCommands::Filter VelocityCommands::make(
    const std::shared_ptr<const berth::Robot>& robot,
    const berth::VelocityFilterSettings& settings) const {
  std::vector<std::string> names;
  for (const berth::MovableJoint& joint : robot->model().joints) names.push_back(joint.name);
  Filter made;
  for (const std::string& joint : joints_.empty() ? names : joints_) {
    const std::size_t place = std::ranges::find(names, joint) - names.begin();
    const bool is_twice = std::ranges::find(made.places, place) != made.places.end();
    if (place == names.size() || is_twice) {
      throw std::invalid_argument("filter.joints: \"" + joint + "\" " +
                                  (is_twice ? "stands twice" : "is no joint of the robot") +
                                  "; expected some of " + joined(names));
    }
    made.places.push_back(place);
  }
  std::vector<std::size_t> others;
  for (std::size_t place = 0; place < names.size(); ++place) {
    if (std::ranges::find(made.places, place) == made.places.end()) others.push_back(place);
  }
  made.names = joined(joints_.empty() ? names : joints_);
  made.filter = std::make_unique<berth::VelocityFilter>(robot, settings, others);
  return made;
}

void VelocityCommands::use(Filter filter) {
  const std::lock_guard lock(mutex_);
  filter_ = std::move(filter);
  wanted_.clear();
  refused_.clear();
  allowed_ = {};
}

void VelocityCommands::take(const Message& wanted) {
  const std::lock_guard lock(mutex_);
  if (!filter_.filter) return;
  heard_ = Clock::now();
  wanted_.clear();
  refused_.clear();
  const bool is_finite = berth::are_finite(wanted.data, wanted.data.size());
  if (wanted.data.size() == filter_.places.size() && is_finite) {
    wanted_ = wanted.data;
    return;
  }
  refused_ = "wanted_velocity: " + std::to_string(wanted.data.size()) + " numbers" +
             (is_finite ? "" : ", not all finite") + "; expected " +
             std::to_string(filter_.places.size()) + " finite ones, of " + filter_.names;
}

void VelocityCommands::allow(const berth::Result& result, std::span<const double> position,
                             std::span<const double> velocity, Message& out) {
  const std::lock_guard lock(mutex_);
  out.data.assign(filter_.places.size(), 0.0);
  if (!filter_.filter) return;
  const Clock::time_point now = Clock::now();
  if (now - heard_ > kMostSilence) {
    wanted_.clear();
    refused_.clear();
  }
  asked_.assign(position.size(), 0.0);
  for (std::size_t k = 0; k < wanted_.size(); ++k) asked_[filter_.places[k]] = wanted_[k];
  const berth::FilteredVelocity& allowed =
      filter_.filter->update(result, {position, velocity, asked_});
  for (std::size_t k = 0; k < out.data.size(); ++k) {
    out.data[k] = allowed.velocity[filter_.places[k]];
  }
  trouble_ = trouble_of(allowed, result);
  held_by_ = held_by(allowed, result);
  scale_ = allowed.scale;
  if (allowed_ != Clock::time_point()) longest_s_ = std::max(longest_s_, seconds(now - allowed_));
  allowed_ = now;
  oldest_joints_s_ = std::fmax(oldest_joints_s_, result.time.joints_age_s);
}

void VelocityCommands::stopped(const std::string& why) {
  const std::lock_guard lock(mutex_);
  trouble_ = "stopped: " + why;
  held_by_.clear();
  scale_ = 0;
  allowed_ = {};
}

std::string VelocityCommands::trouble() const {
  const std::lock_guard lock(mutex_);
  return refused_.empty() ? trouble_ : refused_;
}

std::string VelocityCommands::doubt() const {
  if (!filter_.filter) return "";
  const berth::VelocityFilterSettings& settings = filter_.filter->settings();
  if (longest_s_ > settings.period_s) {
    return "a velocity was obeyed for " + in_ms(longest_s_) + "; filter.period_s is " +
           in_ms(settings.period_s);
  }
  if (oldest_joints_s_ > settings.latency_s) {
    return "joints were " + in_ms(oldest_joints_s_) + " old; filter.latency_s is " +
           in_ms(settings.latency_s);
  }
  return "";
}

void VelocityCommands::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::string trouble = this->trouble();
  const std::lock_guard lock(mutex_);
  status.add("joints", filter_.names);
  status.add("scale", scale_);
  status.add("held by", held_by_);
  status.add("longest time that a velocity was obeyed, s", longest_s_);
  status.add("greatest age of joints, s", oldest_joints_s_);
  const std::string doubt = this->doubt();
  longest_s_ = oldest_joints_s_ = 0;
  using diagnostic_msgs::msg::DiagnosticStatus;
  if (!trouble.empty()) return status.summary(DiagnosticStatus::ERROR, trouble);
  if (wanted_.empty()) return status.summary(DiagnosticStatus::OK, "nothing is wanted");
  if (!doubt.empty()) return status.summary(DiagnosticStatus::WARN, doubt);
  status.summary(DiagnosticStatus::OK, "filtered");
}

}  // namespace berth_ros
