#pragma once

#include <chrono>
#include <ctime>

namespace berth::bench {

/// Time since it was made, by the clock on the wall.
class Stopwatch {
 public:
  double ms() const {
    const std::chrono::duration<double, std::milli> took = Clock::now() - start_;
    return took.count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Processor time of the whole program since it was made: what one thread would take by the clock
/// on the wall, had it a processor to itself.
class ProcessorStopwatch {
 public:
  double ms() const { return now_ms() - start_ms_; }

 private:
  static double now_ms() {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
  }

  double start_ms_ = now_ms();
};

}  // namespace berth::bench
