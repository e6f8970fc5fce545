#pragma once

#include <atomic>
#include <builtin_interfaces/msg/time.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <rclcpp/time.hpp>
#include <stdexcept>
#include <string>

namespace berth_ros {

/// ROS stamps as berth's seconds, counted from the first one that comes: so near to it a double
/// holds nanoseconds exactly, and an image's stamp leaves the node as it came.
class StampClock {
 public:
  /// NaN for a clock that has not begun: 0.
  double seconds(const rclcpp::Time& now) {
    return now.nanoseconds() > 0 ? since_epoch(now.nanoseconds())
                                 : std::numeric_limits<double>::quiet_NaN();
  }
  /// Throws std::invalid_argument for what is no time, or none at all (0).
  double seconds(const builtin_interfaces::msg::Time& stamp) {
    return since_epoch(nanoseconds(stamp));
  }
  /// As seconds(), since 1970.
  static std::int64_t nanoseconds(const builtin_interfaces::msg::Time& stamp) {
    const bool is_time = stamp.sec >= 0 && stamp.nanosec < kSecond_ns;
    const std::int64_t ns = stamp.sec * kSecond_ns + stamp.nanosec;
    if (is_time && ns > 0) return ns;
    throw std::invalid_argument("stamp: sec " + std::to_string(stamp.sec) + ", nanosec " +
                                std::to_string(stamp.nanosec) +
                                "; expected a time above 0, with less than 1000000000 ns");
  }
  /// 0 for a time that is not known, or before 1970; the last one that a stamp holds for a later
  /// one.
  builtin_interfaces::msg::Time stamp(double seconds) const {
    builtin_interfaces::msg::Time stamp;
    if (!std::isfinite(seconds) || std::abs(seconds) > kMost_s) return stamp;
    const std::int64_t ns = std::llround(seconds * 1e9) + epoch_ns_.load();
    if (ns <= 0) return stamp;
    stamp.sec = static_cast<std::int32_t>(std::min<std::int64_t>(ns / kSecond_ns, INT32_MAX));
    stamp.nanosec = static_cast<std::uint32_t>(ns % kSecond_ns);
    return stamp;
  }

 private:
  static constexpr std::int64_t kUnset = INT64_MIN;
  static constexpr std::int64_t kSecond_ns = 1'000'000'000;
  /// Of stamps, from the first to the last.
  static constexpr double kMost_s = 2.0 * INT32_MAX;

  double since_epoch(std::int64_t ns) {
    std::int64_t epoch_ns = kUnset;
    epoch_ns_.compare_exchange_strong(epoch_ns, ns);
    return static_cast<double>(ns - epoch_ns_.load()) * 1e-9;
  }

  std::atomic<std::int64_t> epoch_ns_{kUnset};
};

}  // namespace berth_ros
