#include "speed_monitor.hpp"

#include <algorithm>
#include <limits>

#include "berth/pipeline/request.hpp"
#include "berth/results/result_text.hpp"

namespace berth_ros {
namespace {

using berth_msgs::msg::Separation;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void copy_links(const berth::Result& result, Separation& out) {
  out.links.clear();
  for (const berth::LinkSeparation& link : result.separation->links) {
    if (!link.is_moved) continue;
    auto& message = out.links.emplace_back();
    message.link = result.links[link.id - 1].link;
    message.speed_m_s = link.speed_m_s;
    message.distance_m = link.distance_m;
    message.required_m = link.required_m;
    message.margin_m = link.margin_m;
    message.speed_scale = link.speed_scale;
    message.reason = name_of(link.reason);
  }
}

}  // namespace

void PlannedVelocity::take(const sensor_msgs::msg::JointState& message,
                           const berth::RobotModel& model, double stamp_s) {
  stamp_s_ = stamp_s;
  velocity_.assign(model.joints.size(), kNaN);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const auto found = std::find(message.name.begin(), message.name.end(), model.joints[i].name);
    const std::size_t at = found - message.name.begin();
    const bool is_there = found != message.name.end() && at < message.velocity.size();
    if (is_there) velocity_[i] = message.velocity[at];
  }
}

void PlannedVelocity::begin_anew(const berth::RobotModel& model) {
  if (is_there()) velocity_.assign(model.joints.size(), kNaN);
}

const std::vector<double>& PlannedVelocity::at(double now_s, double max_age_s) {
  const double age_s = now_s - stamp_s_;
  if (!(age_s >= -berth::kMostJointsAhead_s && age_s <= max_age_s))
    std::fill(velocity_.begin(), velocity_.end(), kNaN);
  return velocity_;
}

void to_message(const berth::Result& result, bool is_planned, Separation& out) {
  const berth::Separation& separation = *result.separation;
  out.is_planned = is_planned;
  out.state = static_cast<std::uint8_t>(separation.state);
  out.speed_scale = separation.speed_scale;
  out.basis = name_of(separation.basis);
  out.reason = name_of(separation.reason);
  out.text = berth::separation_text(result);
  out.reaction_time_s = separation.reaction_time_s;
  copy_links(result, out);
}

void say_unmonitored(Separation& out) {
  out.state = Separation::UNMONITORED;
  out.speed_scale = out.reaction_time_s = kNaN;
  out.is_planned = false;
  out.basis.clear();
  out.reason.clear();
  out.text.clear();
  out.links.clear();
}

void say_stop(const std::string& text, Separation& out) {
  say_unmonitored(out);
  out.state = Separation::STOP;
  out.speed_scale = 0;
  out.reason = name_of(berth::SeparationReason::stale);
  out.text = "stop: " + text;
}

}  // namespace berth_ros
