#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace berth_ros {

/// How far whole joint samples lie apart, by their stamps. Where joint states come more seldom than
/// they may be old, answers would be known and not known in turns: so they are not known until none
/// of the last gaps is too long.
class JointRhythm {
 public:
  /// The newest sample's stamp, as often as one likes.
  void add(double stamp_s) {
    if (stamp_s == newest_s_) return;
    const double gap_s = stamp_s - newest_s_;
    newest_s_ = stamp_s;
    if (gap_s > 0) {
      gaps_s_[next_++ % gaps_s_.size()] = gap_s;
    } else {
      // A clock that was set back.
      gaps_s_ = {};
    }
  }
  /// Of the last gaps; 0 before there was one.
  double longest_gap_s() const { return *std::max_element(gaps_s_.begin(), gaps_s_.end()); }

 private:
  std::array<double, 8> gaps_s_ = {};
  std::size_t next_ = 0;
  double newest_s_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace berth_ros
