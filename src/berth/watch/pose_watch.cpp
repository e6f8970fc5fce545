#include "berth/watch/pose_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace berth {
namespace {

/// NaN where there is none.
double greatest(std::span<const double> values) {
  double most = std::numeric_limits<double>::quiet_NaN();
  for (const double value : values) most = std::fmax(most, value);
  return most;
}

}  // namespace

void validate(const WatchSettings& settings) {
  visit_settings(settings, SettingCheck{"watch"});
  // With half of them or fewer, the same frames could say both.
  if (settings.agreeing_frames > settings.frames ||
      2 * settings.agreeing_frames <= settings.frames) {
    throw_bad_setting("watch", "agreeing_frames", settings.agreeing_frames,
                      "more than half of watch.frames, " + std::to_string(settings.frames) +
                          ", and no more than all");
  }
}

WatchSettings learned_limits(std::span<const double> seen_through,
                             std::span<const double> displacement_m) {
  WatchSettings settings;
  const double most_seen_through = greatest(seen_through);
  if (!std::isnan(most_seen_through)) {
    settings.max_seen_through = std::clamp(2 * most_seen_through + 0.01, 0.03, 1.0);
  }
  const double most_m = greatest(displacement_m);
  if (!std::isnan(most_m)) settings.max_displacement_m = std::max(1.5 * most_m, 0.008);
  return settings;
}

namespace {

void copy(DepthView from, DepthImage& to) {
  if (to.width() != from.width || to.height() != from.height) {
    to.resize(from.width, from.height, kNoDepth);
  }
  for (int v = 0; v < from.height; ++v) std::copy_n(from.row(v), from.width, to.row(v));
}

constexpr int kAgreeingChecks = 2, kChecks = 3;

bool tells_displacement(const RobotReadings& robot) {
  return robot.judged() + robot.before >= kLeastJudgedPixels &&
         robot.hidden_share() <= kMostHiddenForDisplacement;
}

const WatchSettings& checked(const WatchSettings& settings) {
  validate(settings);
  return settings;
}

}  // namespace

PoseWatch::PoseWatch(const WatchSettings& settings, MeasureDisplacement measure,
                     const CameraWatch& before)
    : settings_(checked(settings)),
      by_seen_through_(settings.agreeing_frames, settings.frames),
      by_displacement_(kAgreeingChecks, kChecks),
      by_place_(settings.agreeing_frames, settings.frames) {
  state_.is_on = settings.is_on();
  begin_with(before);
  if (settings.max_displacement_m == 0) return;
  if (!measure) {
    throw_bad_setting("watch", "max_displacement_m", settings.max_displacement_m,
                      "0, since nothing measures it");
  }
  check_.emplace(std::move(measure));
}

void PoseWatch::begin_with(const CameraWatch& before) {
  const bool has_D = settings_.max_displacement_m > 0, has_T = settings_.max_seen_through > 0;
  if (before.has_moved && state_.is_on) {
    // Where the last D does not say so, T did, or else D's two of three have to take it back.
    const bool by_D = has_D && (before.displacement_m > settings_.max_displacement_m || !has_T);
    by_displacement_.begin(by_D);
    by_seen_through_.begin(has_T && (!by_D || before.seen_through > settings_.max_seen_through));
    state_.has_moved = true;
  }
  if (settings_.min_at_robot > 0 && (before.is_implausible || before.is_unconfirmed)) {
    by_place_.begin(true);
    has_place_verdict_ = true;
    tell_place();
  }
}

const CameraWatch& PoseWatch::look(DepthView depth_m, const RobotImage& robot,
                                   const JointState& at_exposure, const Pose& X_PC) {
  if (!state_.is_on && settings_.min_at_robot == 0) return state_;
  const RobotReadings readings = read_robot(depth_m, robot, settings_.bias_m);
  judge_place(readings);
  if (!state_.is_on) return state_;
  const bool tells = readings.tells();
  state_.seen_through = tells ? readings.seen_through() : std::numeric_limits<double>::quiet_NaN();
  if (tells && settings_.max_seen_through > 0) {
    by_seen_through_.add(state_.seen_through > settings_.max_seen_through);
  }
  take_displacement();
  if (check_ && tells_displacement(readings) && is_due(at_exposure.stamp_s) &&
      check_->start(depth_m, at_exposure, X_PC)) {
    begun_s_ = at_exposure.stamp_s;
  }
  return state_;
}

void PoseWatch::judge_place(const RobotReadings& readings) {
  if (settings_.min_at_robot == 0) return;
  const bool tells = readings.tells();
  state_.is_hidden = readings.is_hidden();
  state_.at_robot = tells ? readings.at_robot() : std::numeric_limits<double>::quiet_NaN();
  if (!tells) return;
  const bool verdict = state_.at_robot < settings_.min_at_robot;
  if (std::exchange(has_place_verdict_, true)) {
    by_place_.add(verdict);
  } else {
    by_place_.begin(verdict);
  }
  tell_place();
}

void PoseWatch::tell_place() {
  state_.is_implausible = by_place_.state() && !settings_.tell_only;
  state_.is_unconfirmed = by_place_.state() && settings_.tell_only;
}

const CameraWatch& PoseWatch::pass_over() {
  state_.is_hidden = false;
  state_.at_robot = std::numeric_limits<double>::quiet_NaN();
  state_.seen_through = std::numeric_limits<double>::quiet_NaN();
  take_displacement();
  return state_;
}

const CameraWatch& PoseWatch::wait() {
  if (check_) check_->wait();
  take_displacement();
  return state_;
}

void PoseWatch::take_displacement() {
  const auto result = check_ ? check_->take() : std::nullopt;
  if (result && *result) {
    state_.displacement_m = **result;
    by_displacement_.add(state_.displacement_m > settings_.max_displacement_m);
  }
  state_.has_moved = by_seen_through_.state() || by_displacement_.state();
}

bool PoseWatch::is_due(double stamp_s) const {
  // Stamps that went back are a recording's that begins anew.
  return !begun_s_ || stamp_s < *begun_s_ || stamp_s >= *begun_s_ + settings_.check_every_s;
}

DisplacementCheck::DisplacementCheck(MeasureDisplacement measure)
    : measure_(std::move(measure)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

bool DisplacementCheck::start(DepthView depth_m, const JointState& at_exposure, const Pose& X_PC) {
  const std::lock_guard lock(mutex_);
  if (step_ != Step::idle) return false;
  copy(depth_m, depth_m_);
  at_exposure_ = at_exposure;
  X_PC_ = X_PC;
  step_ = Step::asked;
  changed_.notify_all();
  return true;
}

std::optional<std::optional<double>> DisplacementCheck::take() {
  const std::lock_guard lock(mutex_);
  if (step_ != Step::done) return std::nullopt;
  step_ = Step::idle;
  return result_;
}

void DisplacementCheck::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return step_ != Step::asked; });
}

void DisplacementCheck::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return step_ == Step::asked; })) {
    lock.unlock();
    const std::optional<double> result = measure_(depth_m_, at_exposure_, X_PC_, stop);
    lock.lock();
    result_ = result;
    step_ = Step::done;
    changed_.notify_all();
    if (stop.stop_requested()) return;
  }
}

}  // namespace berth
