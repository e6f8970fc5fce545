// Inside separation/ only.
#pragma once

#include <optional>

namespace berth {

/// A scale of the robot's speed that falls at once and rises late.
class SpeedHold {
 public:
  /// `release_s`: how long `rising` has to lie above the scale.
  explicit SpeedHold(double release_s) : release_s_(release_s) {}

  /// `falling` is what is allowed now, `rising` the same with room to spare: not above it. The
  /// scale is never above `falling`. A time that goes back, or is NaN, begins the wait anew.
  double next(double falling, double rising, double now_s);

 private:
  double release_s_;
  double scale_ = 0;
  /// The least of `rising` since it last lay at or below the scale, and when that was.
  double least_rising_ = 1;
  std::optional<double> waits_since_s_;
  double last_s_ = 0;
};

}  // namespace berth
