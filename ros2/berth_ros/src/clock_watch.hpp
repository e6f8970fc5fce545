#pragma once

#include <algorithm>
#include <chrono>
#include <mutex>
#include <rclcpp/clock.hpp>

namespace berth_ros {

/// Whether a node's clock goes on, held against the steady clock. Any thread may look.
class ClockWatch {
 public:
  /// A clock that has not changed for so long stands: a simulation that is paused, or has ended.
  static constexpr double kStands_s = 0.15;

  /// To be called often: how far the clock was set back since the call before, s; 0 as a rule.
  double look(rclcpp::Clock& clock) {
    const std::lock_guard lock(mutex_);
    const std::int64_t now_ns = clock.now().nanoseconds();
    const double back_s = 1e-9 * static_cast<double>(std::max<std::int64_t>(0, last_ns_ - now_ns));
    if (now_ns != last_ns_) changed_ = Steady::now();
    last_ns_ = now_ns;
    return back_s;
  }
  bool stands() const {
    const std::lock_guard lock(mutex_);
    return Steady::now() - changed_ > std::chrono::duration<double>(kStands_s);
  }

 private:
  using Steady = std::chrono::steady_clock;
  mutable std::mutex mutex_;
  std::int64_t last_ns_ = 0;
  Steady::time_point changed_ = Steady::now();
};

}  // namespace berth_ros
