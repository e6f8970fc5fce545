#include "berth/live/live_camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "berth/live/turns.hpp"
#include "berth/pipeline/observer.hpp"

namespace berth {
namespace {

constexpr double kLongestWait_s = 60;

double steady_now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void validate(const LiveCameraSettings& settings) {
  if (!std::isfinite(settings.clock_offset_s)) {
    throw std::invalid_argument(
        fmt::format("clock_offset_s: {}; expected a finite number", settings.clock_offset_s));
  }
  if (!(settings.max_wait_s >= 0 && settings.max_wait_s <= kLongestWait_s)) {
    throw std::invalid_argument(fmt::format("max_wait_s: {}; expected a number from 0 to {}",
                                            settings.max_wait_s, kLongestWait_s));
  }
}

}  // namespace

LiveCamera::LiveCamera(std::shared_ptr<const MountedCamera> mounted, const JointIntake& joints,
                       LiveCameraSettings settings, OnFrame on_frame, FindPlace find_place,
                       const CameraWatch& before)
    : mounted_(std::move(mounted)),
      joints_(joints),
      settings_(settings),
      on_frame_(std::move(on_frame)),
      find_place_(std::move(find_place)),
      before_(before) {
  validate(settings_);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

LiveCamera::~LiveCamera() = default;

void LiveCamera::push(double stamp_s, DepthImage depth_m, std::shared_ptr<const void> with) {
  require_size(mounted_->camera(), depth_m);
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() == kMostWaitingImages) drop(waiting_.end() - 1);
    waiting_.push_back({stamp_s, std::move(depth_m), std::move(with), steady_now_s()});
  }
  changed_.notify_one();
}

DepthImage LiveCamera::spare_image() {
  const std::lock_guard lock(mutex_);
  if (spare_.empty()) return {};
  DepthImage image = std::move(spare_.back());
  spare_.pop_back();
  return image;
}

void LiveCamera::look_again() {
  // Taken, so that the thread is not between its look at joints and place and its sleep.
  { const std::lock_guard lock(mutex_); }
  changed_.notify_one();
}

std::shared_ptr<const Frame> LiveCamera::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

LiveCameraCounts LiveCamera::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

bool LiveCamera::has_joints(const Waiting& image) const {
  return joints_.buffer().newest_stamp_s() >= image.stamp_s + settings_.clock_offset_s;
}

std::optional<PlaceAtExposure> LiveCamera::place_of(const Waiting& image) const {
  return find_place_ ? find_place_(image.stamp_s) : PlaceAtExposure{};
}

bool LiveCamera::is_ready(const Waiting& image) const {
  // No joints will ever lie behind a stamp that is no number.
  return !std::isfinite(image.stamp_s) || (has_joints(image) && place_of(image)) ||
         steady_now_s() >= image.since_s + settings_.max_wait_s;
}

bool LiveCamera::wait_for_image(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (true) {
    if (!changed_.wait(lock, stop, [&] { return !waiting_.empty(); })) return false;
    // While it waits, a newer image may take its place.
    const double wait_s = waiting_.front().since_s + settings_.max_wait_s - steady_now_s();
    changed_.wait_for(lock, stop, std::chrono::duration<double>(std::max(0.0, wait_s)),
                      [&] { return is_ready(waiting_.front()); });
    if (stop.stop_requested()) return false;
    if (is_ready(waiting_.front())) return true;
  }
}

std::optional<LiveCamera::Waiting> LiveCamera::take_newest() {
  const std::lock_guard lock(mutex_);
  // Of three that wait the first one may have been dropped, and the others still wait for joints.
  if (waiting_.empty() || !is_ready(waiting_.front())) return std::nullopt;
  while (waiting_.size() > 1 && is_ready(waiting_[1])) drop(waiting_.begin());
  Waiting image = std::move(waiting_.front());
  waiting_.pop_front();
  return image;
}

void LiveCamera::drop(std::deque<Waiting>::iterator image) {
  spare_.push_back(std::move(image->depth_m));
  waiting_.erase(image);
  ++counts_.dropped;
}

std::shared_ptr<const Frame> LiveCamera::observe(Observer& observer, const Waiting& image) {
  const double begin_s = steady_now_s();
  const std::shared_ptr<Frame> frame = pool_.take();
  observer.observe(image.depth_m, image.stamp_s, joints_.buffer(), *frame, settings_.clock_offset_s,
                   place_of(image));
  if (is_distrusted_) {
    const bool is_told_only = mounted_->settings().watch.tell_only;
    (is_told_only ? frame->watch.is_unconfirmed : frame->watch.is_implausible) = true;
  }
  keep(image, frame, begin_s);
  return frame;
}

void LiveCamera::keep(const Waiting& image, const std::shared_ptr<const Frame>& frame,
                      double begin_s) {
  const std::lock_guard lock(mutex_);
  newest_ = frame;
  ++counts_.images;
  counts_.stale += frame->time.status != TimeStatus::ok;
  counts_.last_wait_s = begin_s - image.since_s;
  counts_.longest_wait_s = std::max(counts_.longest_wait_s, counts_.last_wait_s);
  counts_.last_observe_s = steady_now_s() - begin_s;
  counts_.failure.clear();
}

void LiveCamera::take(Observer& observer, const Waiting& image) {
  try {
    const std::shared_ptr<const Frame> frame = observe(observer, image);
    // Within the turn: so a frame that is put into a LiveSpace there is made ready next.
    if (on_frame_) on_frame_(frame, image.depth_m, image.with);
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    ++counts_.failed;
    counts_.failure = error.what();
  }
}

void LiveCamera::run(const std::stop_token& stop) {
  Observer observer(mounted_, {}, before_);
  while (wait_for_image(stop)) {
    const ImageTurn turn(stop);
    if (!turn.has_come()) return;
    std::optional<Waiting> image = take_newest();
    if (!image) continue;
    take(observer, *image);
    const std::lock_guard lock(mutex_);
    spare_.push_back(std::move(image->depth_m));
  }
}

}  // namespace berth
