#pragma once

#include <array>

namespace berth {

/// How a lens bends what a pinhole would show, as ROS and OpenCV have it.
struct Lens {
  /// Of the angle to the axis (Kannala and Brandt, "equidistant"), not of the radius (Brown and
  /// Conrady, "plumb_bob", "rational_polynomial").
  bool is_fisheye = false;
  /// k1, k2, p1, p2, k3, k4, k5, k6, or a fisheye's k1 to k4; 0 beyond those that are given.
  std::array<double, 8> coefficients{};

  bool operator==(const Lens&) const = default;
};

}  // namespace berth
