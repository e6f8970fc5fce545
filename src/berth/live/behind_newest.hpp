#pragma once

namespace berth {

/// Tells a clock that was set back from late messages, by the stamps of one source as they come.
/// Those of a publisher that lags come among newer ones; those of another time follow one another
/// for longer.
class BehindNewest {
 public:
  /// How many make a clock that was set back, and how much time they span at least.
  static constexpr int kInARow = 3;
  static constexpr double kSpan_s = 0.1;

  /// Whether this stamp, which lies so far behind the newest one, ends such a row: each above the
  /// one before it.
  bool is_set_back(double behind_s) {
    if (behind_s < 0) count_ = 0;
    if (!(behind_s > 0)) return false;
    if (count_ == 0 || behind_s > last_s_) {
      count_ = 1;
      first_s_ = behind_s;
    } else {
      count_ += behind_s < last_s_;
    }
    last_s_ = behind_s;
    return count_ >= kInARow && first_s_ - last_s_ >= kSpan_s;
  }

 private:
  int count_ = 0;
  double first_s_ = 0;
  double last_s_ = 0;
};

}  // namespace berth
