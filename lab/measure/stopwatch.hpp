#pragma once

#include <ctime>

namespace berth::lab {

/// Time since it was made, by the clock on the wall unless another clock is named.
class Stopwatch {
 public:
  /// CLOCK_PROCESS_CPUTIME_ID: processor time of the whole program; what one thread would take by
  /// the clock on the wall, had it a processor to itself.
  explicit Stopwatch(clockid_t clock = CLOCK_MONOTONIC) : clock_(clock) {}

  double ms() const { return now_ms() - start_ms_; }

 private:
  double now_ms() const {
    timespec now;
    clock_gettime(clock_, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
  }

  clockid_t clock_;
  double start_ms_ = now_ms();
};

}  // namespace berth::lab
