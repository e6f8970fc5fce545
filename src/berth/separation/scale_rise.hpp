// Inside separation/ only.
#pragma once

#include <limits>

namespace berth {

/// How fast a scale of the robot's speed may rise. It falls at once.
class ScaleRise {
 public:
  ScaleRise() = default;
  /// As one that has come so far.
  ScaleRise(bool is_first, double scale, double last_s)
      : is_first_(is_first), scale_(scale), last_s_(last_s) {}

  /// The greatest scale at now_s, if it gains `per_s` of a second in each. The first time it may be
  /// anything, since nobody knows how fast the robot is; where the clock was set back, no more than
  /// before.
  double most(double now_s, double per_s) {
    const double passed_s = now_s - last_s_;
    last_s_ = now_s;
    if (is_first_) return 1;
    if (!(passed_s > 0)) return scale_;
    const double risen = scale_ + passed_s * per_s;
    return risen < 1 ? risen : 1;
  }
  void take(double scale) {
    scale_ = scale;
    is_first_ = false;
  }
  bool is_first() const { return is_first_; }
  double scale() const { return scale_; }
  double last_s() const { return last_s_; }

 private:
  bool is_first_ = true;
  double scale_ = 0;
  double last_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace berth
