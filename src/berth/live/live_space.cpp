#include "berth/live/live_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "berth/live/turns.hpp"
#include "berth/pipeline/request.hpp"

namespace berth {
namespace {

double steady_now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::size_t require_count(std::size_t cameras) {
  if (cameras >= 1 && cameras <= kMostCameras) return cameras;
  throw std::invalid_argument(fmt::format("cameras: {}; expected 1 to {}", cameras, kMostCameras));
}

}  // namespace

LiveSpace::LiveSpace(std::shared_ptr<const Robot> robot, std::size_t cameras,
                     const JointIntake& joints)
    : robot_(std::move(robot)),
      joints_(joints),
      frames_(require_count(cameras)),
      newest_(std::make_shared<PreparedSpace>(robot_, cameras)) {
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

LiveSpace::~LiveSpace() = default;

void LiveSpace::put(std::size_t camera, std::shared_ptr<const Frame> frame) {
  {
    const std::lock_guard lock(mutex_);
    frames_.at(camera) = std::move(frame);
    has_changed_ = true;
  }
  changed_.notify_one();
}

std::shared_ptr<const PreparedSpace> LiveSpace::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

LiveSpaceCounts LiveSpace::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

bool LiveSpace::wait_for_frames(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  return changed_.wait(lock, stop, [this] { return has_changed_; });
}

void LiveSpace::run(const std::stop_token& stop) {
  std::vector<std::shared_ptr<const Frame>> frames;
  while (wait_for_frames(stop)) {
    const ImageTurn turn(stop);
    if (!turn.has_come()) return;
    {
      const std::lock_guard lock(mutex_);
      has_changed_ = false;
      frames = frames_;
    }
    try {
      prepare(frames);
    } catch (const std::exception&) {
      const std::lock_guard lock(mutex_);
      ++counts_.failed;
    }
  }
}

void LiveSpace::prepare(const std::vector<std::shared_ptr<const Frame>>& frames) {
  const double begin_s = steady_now_s();
  const std::shared_ptr<PreparedSpace> space =
      pool_.take([&] { return std::make_unique<PreparedSpace>(robot_, frames.size()); });
  const bool has_joints = joints_.buffer().newest(asked_) == TimeStatus::ok;
  space->prepare(frames, has_joints ? &asked_ : nullptr);
  // The robot has gone on meanwhile.
  if (joints_.buffer().newest(asked_) == TimeStatus::ok) space->search(asked_);
  const double took_s = steady_now_s() - begin_s;
  // The set before is given back when nobody waits for the mutex.
  std::shared_ptr<const PreparedSpace> newest = space;
  const std::lock_guard lock(mutex_);
  newest_.swap(newest);
  ++counts_.prepared;
  counts_.last_prepare_s = took_s;
  counts_.most_prepare_s = std::max(counts_.most_prepare_s, took_s);
}

}  // namespace berth
