#include "lab/closed_loop/census.hpp"

#include <algorithm>
#include <limits>

#include "berth/separation/protective_distance.hpp"

namespace berth::lab {
namespace {

/// From one judgement to the next, and from one place that is looked at to the next.
constexpr double kBetween_s = 0.04;
/// How far ahead somebody's true motion is looked at.
constexpr double kAhead_s = 1;
/// At its stations the arm has no speed that a scale could be a share of.
constexpr double kSlowest_m_s = 0.02;

}  // namespace

std::string main_cause(const LostTimes& lost) {
  const auto most = std::ranges::max_element(
      lost, {}, [](const LostTimes::value_type& cause) { return cause.second.sum_s(); });
  return most == lost.end() ? "none" : most->first;
}

double needed_share(const LostTimes& lost) {
  double needed_s = 0, all_s = 0;
  for (const auto& [cause, time] : lost) {
    needed_s += time.needed_s;
    all_s += time.sum_s();
  }
  return all_s > 0 ? needed_s / all_s : 0;
}

Census::Census(const RobotModel& model, const sim::TrueClearance& clearance, Assumption assumed,
               double age_s)
    : clearance_(clearance),
      assumed_(std::move(assumed)),
      age_s_(age_s),
      arm_(model, 0),
      judged_s_(-std::numeric_limits<double>::infinity()) {}

void Census::add(double now_s, double for_s, double scale, std::string_view cause, double phase_s,
                 const People& people_after) {
  if (scale >= 1) return;
  if (cause_.empty() && cause == name_of(SeparationReason::stale)) return;
  if (cause != name_of(SeparationReason::speeding_up)) {
    if (now_s - judged_s_ >= kBetween_s || cause != cause_) {
      judge(phase_s, people_after);
      judged_s_ = now_s;
    }
    cause_ = cause;
    false_share_ = is_needed_ ? 0 : std::max(0.0, rightful_scale_ - scale) / (1 - scale);
  }
  if (cause_.empty()) return;
  LostTime& lost = lost_[cause_];
  const double lost_s = (1 - scale) * for_s;
  lost.false_s += false_share_ * lost_s;
  (is_needed_ ? lost.needed_s : lost.allowed_s) += (1 - false_share_) * lost_s;
}

void Census::judge(double phase_s, const People& people_after) {
  is_needed_ = is_needed(phase_s, people_after);
  if (!is_needed_) rightful_scale_ = rightful_scale(phase_s, people_after(0));
}

double Census::clearance_m(double phase_s, const std::vector<Pose>& X_BP) {
  arm_.go_to(phase_s);
  return clearance_.at_least(arm_.pose(), X_BP);
}

bool Census::is_needed(double phase_s, const People& people_after) {
  const double reaction_s = assumed_.settings.reaction_time_s;
  for (double after_s = 0; after_s <= kAhead_s; after_s += kBetween_s) {
    const double away_m = clearance_m(phase_s + after_s, people_after(after_s));
    const double v_m_s = arm_.full_m_s();
    const double stop_m = stopping_from(assumed_.settings, v_m_s).distance_m;
    if (away_m <= v_m_s * reaction_s + stop_m) return true;
  }
  return false;
}

double Census::rightful_scale(double phase_s, const std::vector<Pose>& X_BP) {
  constexpr int kHalvings = 5;
  if (has_room(1, phase_s, X_BP)) return 1;
  double enough = 0, too_much = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (enough + too_much) / 2;
    (has_room(middle, phase_s, X_BP) ? enough : too_much) = middle;
  }
  return enough;
}

bool Census::has_room(double scale, double phase_s, const std::vector<Pose>& X_BP) {
  const SeparationSettings& settings = assumed_.settings;
  const double gain_m_s = settings.acceleration_m_s2 * settings.reaction_time_s;
  const double reaction_s = settings.reaction_time_s + age_s_;
  const double away_m = clearance_m(phase_s, X_BP);
  const double full_m_s = std::max(arm_.full_m_s(), kSlowest_m_s);
  const double v_m_s = scale * full_m_s + gain_m_s;
  const ProtectiveTerms terms{reaction_s, settings.camera_uncertainty_m.value_or(0)};
  if (!assumed_.is_along_path) {
    return away_m >= protective_distance_m(settings, terms, {v_m_s, v_m_s});
  }
  // S of a robot that stands, and what people walk while it brakes.
  const double standing_m = protective_distance_m(settings, terms, {0, 0});
  const double stop_s = stopping_from(settings, v_m_s).time_s;
  const double on_s = settings.reaction_time_s * v_m_s / full_m_s;
  for (double braked_s = 0;; braked_s = std::min(braked_s + kBetween_s, stop_s)) {
    const double share = braked_s / stop_s;
    // Of the way that it brakes over.
    const double way_s = stop_s * v_m_s / full_m_s * share * (1 - share / 2);
    const double needs_m = standing_m + settings.human_speed_m_s * braked_s;
    if (clearance_m(phase_s + on_s + way_s, X_BP) < needs_m) return false;
    if (braked_s >= stop_s) return away_m >= standing_m;
  }
}

}  // namespace berth::lab
