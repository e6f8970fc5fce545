#include "lab/closed_loop/goals.hpp"

#include <algorithm>
#include <cmath>

#include "lab/closed_loop/cell.hpp"

namespace berth::lab {
namespace {

using Joints = std::vector<double>;

/// As fast as the other policies' path; the URDF allows 1.92 rad/s.
constexpr double kFull_rad_s = 1.85, kGain_rad_s2 = 4;
/// Nearer than this it is there; it comes there no faster than this.
constexpr double kThere_rad = 0.005, kArriving_1_s = 30;

/// What a station takes in an empty room, beside the ways: the last of the arm's speed, and until a
/// new way is obeyed.
constexpr double kStation_s = 0.05;

/// Of the joint that goes farthest.
double greatest_step(const Joints& from, const Joints& to) {
  double most = 0;
  for (std::size_t j = 0; j < from.size(); ++j) most = std::max(most, std::abs(to[j] - from[j]));
  return most;
}

double full_speed_rad_s(double come_rad, double left_rad) {
  const double gained = std::sqrt(2 * kGain_rad_s2 * (std::max(0.0, come_rad) + kThere_rad));
  const double stops = std::min(std::sqrt(2 * kGain_rad_s2 * left_rad), kArriving_1_s * left_rad);
  return std::min({kFull_rad_s, gained, stops});
}

/// Until it has come so far from where it stood.
double start_time_s(double come_rad) {
  constexpr double kRamp_rad = kFull_rad_s * kFull_rad_s / (2 * kGain_rad_s2);
  return come_rad < kRamp_rad ? std::sqrt(2 * come_rad / kGain_rad_s2)
                              : come_rad / kFull_rad_s + kFull_rad_s / (2 * kGain_rad_s2);
}

double way_time_s(double way_rad) { return 2 * start_time_s(way_rad / 2); }

/// Of the time of a way, what is over with so much left of it.
double time_gone_s(double way_rad, double left_rad) {
  const double come_rad = std::max(0.0, way_rad - left_rad);
  return come_rad < left_rad ? start_time_s(come_rad)
                             : way_time_s(way_rad) - start_time_s(left_rad);
}

/// Low and high at three places, one after another from side to side.
Joints station(double side_rad, bool is_high) {
  return {
      side_rad, is_high ? 0.45 : 0.75, 0, -1.35, 0, is_high ? 1.25 : 1.05, -side_rad * 0.4 / 0.9};
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

const std::vector<Joints>& stations_rad() {
  static const std::vector<Joints> all{station(-0.9, false), station(0.9, true),  station(0, false),
                                       station(-0.9, true),  station(0.9, false), station(0, true)};
  return all;
}

GoalSupervisor::GoalSupervisor(std::vector<int> cameras, const SeparationSettings& settings,
                               double request_hz)
    : MonitorSupervisor(std::move(cameras), settings),
      look_(robot()),
      filter_(robot(),
              {.approach_rate_1_s = 4, .period_s = 1 / request_hz, .latency_s = kController_s}),
      last_(stations_rad().size(), 0),
      ease_(stations_rad().size(), 1),
      led_aside_s_(-kInfinity),
      velocity_rad_s_(robot()->model().joints.size(), 0.0) {}

Progress GoalSupervisor::progress() const {
  if (from_rad_.empty()) return {};
  const Joints& goal = stations_rad()[goal_];
  const double way_rad = greatest_step(from_rad_, goal);
  return {reached_s_ + time_gone_s(way_rad, greatest_step(now_.position, goal)), reached_};
}

double GoalSupervisor::scale(const Situation& situation) {
  wanted_rad_s_.assign(velocity_rad_s_.size(), 0.0);
  if (!begin(situation)) {
    velocity_rad_s_ = wanted_rad_s_;
    monitor(wanted_rad_s_, situation.now_s, false);
    return 0;
  }
  choose(situation.now_s);
  if (!changes_) find_wanted();
  obey(situation.now_s);
  return scale_;
}

bool GoalSupervisor::begin(const Situation& situation) {
  const Result& result = ask(situation);
  Joints measured_rad_s;
  constexpr double kWindow_s = 0.004, kStanding_rad_s = 0.02;
  if (situation.joints.newest(now_) != TimeStatus::ok ||
      situation.joints.velocity(kWindow_s, measured_rad_s) != TimeStatus::ok) {
    return false;
  }
  is_standing_ = std::ranges::all_of(
      measured_rad_s, [](double rad_s) { return std::abs(rad_s) < kStanding_rad_s; });
  near_m_ = kCellRange_m;
  for (const LinkResult& link : result.links) {
    if (link.is_moved) near_m_ = std::min<double>(near_m_, link.lower_bound_m);
  }
  return result.status == ResultStatus::ok;
}

void GoalSupervisor::choose(double now_s) {
  // Where somebody may come near it looks whether other stations are better.
  constexpr double kEvery_s = 0.1, kBetter = 1.5, kNear_m = 1.8;
  if (from_rad_.empty()) from_rad_ = now_.position;
  const double left_rad = greatest_step(now_.position, stations_rad()[goal_]);
  if (!changes_ && left_rad <= kThere_rad) {
    reached_s_ = progress().phase_s + kStation_s;
    from_rad_ = stations_rad()[goal_];
    last_[goal_] = ++reached_;
    changes_ = true;
  }
  if (!changes_ && near_m_ < kNear_m && now_s - looked_s_ > kEvery_s) {
    look_at_ways(now_s);
    changes_ = worth(best_station()) > kBetter * worth(goal_);
  }
  if (!changes_ || !is_standing_) return;
  look_at_ways(now_s);
  goal_ = best_station();
  way_rad_ = greatest_step(now_.position, stations_rad()[goal_]);
  changes_ = false;
}

void GoalSupervisor::look_at_ways(double now_s) {
  // Where so much room is left, nobody is near soon; less counts by its third power. While the arm
  // is on its way, people take some of it. The end counts as much as the way: it goes on from
  // there.
  constexpr double kFree_m = 1.8, kLeast_m = 0.02, kComes_m_s = 0.2;
  constexpr int kPlaces = 4;
  looked_s_ = now_s;
  std::vector<JointState> ahead;
  for (const Joints& goal : stations_rad()) {
    for (int i = 1; i <= kPlaces; ++i) {
      ahead.push_back(now_);
      for (std::size_t j = 0; j < goal.size(); ++j) {
        ahead.back().position[j] += (goal[j] - now_.position[j]) * i / kPlaces;
      }
    }
  }
  const Result& looked =
      look_.ask({.frames = newest(), .joints = now_, .now_s = now_s, .ahead = ahead});
  if (looked.ahead.poses.empty()) return;
  std::vector<double> slowness(stations_rad().size(), 0.0);
  for (std::size_t i = 0; i < looked.ahead.poses.size(); ++i) {
    double room_m = kCellRange_m;
    for (std::size_t l = 0; l < looked.links.size(); ++l) {
      if (!looked.links[l].is_moved) continue;
      room_m = std::min<double>(room_m, looked.ahead.poses[i][l].nearest.lower_bound_m);
    }
    const std::size_t station = i / kPlaces;
    const double way_s = way_time_s(greatest_step(now_.position, stations_rad()[station]));
    const double left_m = room_m - kComes_m_s * way_s * (i % kPlaces + 1) / kPlaces;
    const bool is_end = (i + 1) % kPlaces == 0;
    const double share = (is_end ? 0.5 : 0.0) + 0.5 / kPlaces;
    slowness[station] += share * std::pow(kFree_m / std::clamp(left_m, kLeast_m, kFree_m), 3);
  }
  for (std::size_t s = 0; s < slowness.size(); ++s) ease_[s] = 1 / slowness[s];
}

double GoalSupervisor::worth(std::size_t station) const {
  constexpr double kChange_s = 0.3;
  if (station == goal_ || changes_) return ease_[station];
  const double way_s = way_time_s(greatest_step(from_rad_, stations_rad()[station]));
  return (way_s + reached_s_ - progress().phase_s) / (way_s / ease_[station] + kChange_s);
}

std::size_t GoalSupervisor::best_station() const {
  // Of those that are free, the one that waits longest; else the one that is worth most.
  constexpr double kFree = 0.8;
  std::size_t best = goal_;
  double most = -kInfinity;
  for (std::size_t s = 0; s < last_.size(); ++s) {
    if (last_[s] == reached_ && reached_ > 0) continue;
    const double value = ease_[s] > kFree ? 1 + reached_ - last_[s] : worth(s);
    if (value <= most) continue;
    most = value;
    best = s;
  }
  return best;
}

void GoalSupervisor::find_wanted() {
  constexpr double kAhead_s = 1.2, kBetween_s = 0.02;
  const Joints& goal = stations_rad()[goal_];
  const double now_left_rad = greatest_step(now_.position, goal);
  const auto speed = [&](double left_rad) {
    return left_rad > kThere_rad ? full_speed_rad_s(way_rad_ - left_rad, left_rad) : 0;
  };
  way_.resize(static_cast<std::size_t>(kAhead_s / kBetween_s) + 1);
  double left_rad = now_left_rad;
  for (std::size_t i = 0; i < way_.size(); ++i) {
    way_[i] = {static_cast<double>(i) * kBetween_s, goal};
    for (std::size_t j = 0; j < goal.size(); ++j) {
      way_[i].position[j] -= (goal[j] - now_.position[j]) * left_rad / now_left_rad;
    }
    left_rad = std::max(kThere_rad, left_rad - speed(left_rad) * kBetween_s);
  }
  for (std::size_t j = 0; j < goal.size(); ++j) {
    wanted_rad_s_[j] = (goal[j] - now_.position[j]) / now_left_rad * speed(now_left_rad);
  }
}

void GoalSupervisor::obey(double now_s) {
  // Longer than the arm takes to obey and to turn.
  constexpr double kTurning_s = 0.4, kSame_rad_s = 1e-6;
  const bool is_straight = now_s - led_aside_s_ > kTurning_s;
  PlannedMotion motion(wanted_rad_s_);
  if (is_straight && !changes_) motion.path = way_;
  scale_ = monitor(motion, now_s, is_straight);
  Joints asked_rad_s = wanted_rad_s_;
  for (double& rad_s : asked_rad_s) rad_s *= scale_;
  const FilteredVelocity& filtered =
      filter_.update(result(), {now_.position, velocity_rad_s_, asked_rad_s});
  velocity_rad_s_ = filtered.velocity;
  if (scale_ <= 0 || greatest_step(velocity_rad_s_, asked_rad_s) < kSame_rad_s) {
    velocity_rad_s_ = scale_ > 0 ? velocity_rad_s_ : asked_rad_s;
    return;
  }
  // While it moves, it leaves its way only where the formula allows as much as the way did; else it
  // stops first.
  for (std::size_t j = 0; j < asked_rad_s.size(); ++j) asked_rad_s[j] = velocity_rad_s_[j] / scale_;
  const double aside = monitor(asked_rad_s, now_s, false);
  if (aside < scale_) {
    const double share = is_straight && !is_standing_ ? 0 : aside / scale_;
    for (double& rad_s : velocity_rad_s_) rad_s *= share;
    scale_ = share * scale_;
  }
  if (scale_ > 0) led_aside_s_ = now_s;
}

}  // namespace berth::lab
