// Inside berth only: a request that is asked again and again, for its times.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "berth/pipeline/result.hpp"

namespace berth {

/// The last result of `ask(i)`, i = 0, 1, ...: asked `repeat` times, and once at least. `timing`
/// gets the times where `repeat` is above 0.
template <class Ask>
const auto& ask_repeatedly(int repeat, const Ask& ask, std::optional<RequestTiming>& timing) {
  std::vector<double> times_us;
  decltype(&ask(0)) result = nullptr;
  for (int i = 0; i < std::max(1, repeat); ++i) {
    const auto start = std::chrono::steady_clock::now();
    result = &ask(i);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    times_us.push_back(took.count());
  }
  if (repeat > 0) timing = timing_of(std::move(times_us));
  return *result;
}

}  // namespace berth
