#include "berth/watch/displacement_check.hpp"

#include <algorithm>

namespace berth {
namespace {

void copy(DepthView from, DepthImage& to) {
  if (to.width() != from.width || to.height() != from.height) {
    to.resize(from.width, from.height, kNoDepth);
  }
  for (int v = 0; v < from.height; ++v) std::copy_n(from.row(v), from.width, to.row(v));
}

}  // namespace

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
