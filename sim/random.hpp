#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace berth::sim {

/// Numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}

  /// Uniform.
  double operator()(double low, double high) {
    return low + (high - low) * (engine_() / 4294967296.0);
  }
  bool chance(double p) { return (*this)(0, 1) < p; }
  /// Uniform, both ends included.
  int whole(int low, int high) { return static_cast<int>((*this)(low, high + 1)); }
  /// Gaussian, of deviation 1.
  double gaussian() {
    const double radius = std::sqrt(-2 * std::log((engine_() + 1.0) / 4294967296.0));
    return radius * std::cos(2 * std::numbers::pi * (*this)(0, 1));
  }

 private:
  std::mt19937 engine_;
};

/// In the cube of which the origin is the middle.
inline Eigen::Vector3d draw_point(Random& random, double reach_m) {
  return {random(-reach_m, reach_m), random(-reach_m, reach_m), random(-reach_m, reach_m)};
}

}  // namespace berth::sim
