#pragma once

#include <atomic>
#include <builtin_interfaces/msg/time.hpp>
#include <cmath>
#include <cstdint>
#include <rclcpp/time.hpp>

namespace berth_ros {

/// ROS stamps as berth's seconds, counted from the first stamp that comes: so near to it a double
/// holds nanoseconds exactly, and an image's stamp leaves the node as it came.
class StampClock {
 public:
  double seconds(const rclcpp::Time& stamp) {
    std::int64_t epoch_ns = kUnset;
    epoch_ns_.compare_exchange_strong(epoch_ns, stamp.nanoseconds());
    return static_cast<double>(stamp.nanoseconds() - epoch_ns_.load()) * 1e-9;
  }
  /// 0 for a time that is not known.
  builtin_interfaces::msg::Time stamp(double seconds) const {
    if (!std::isfinite(seconds)) return builtin_interfaces::msg::Time();
    const std::int64_t ns = std::llround(seconds * 1e9) + epoch_ns_.load();
    return rclcpp::Time(ns < 0 ? 0 : ns);
  }

 private:
  static constexpr std::int64_t kUnset = INT64_MIN;
  std::atomic<std::int64_t> epoch_ns_{kUnset};
};

}  // namespace berth_ros
