#pragma once

#include <random>

namespace berth {

/// The same numbers with every standard library, which its distributions do not give.
class RepeatableRandom {
 public:
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / static_cast<double>(engine_.max());
  }

 private:
  std::mt19937 engine_{1};
};

}  // namespace berth
