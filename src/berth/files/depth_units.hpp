// A depth in metres, and the whole number that stands for it in a 16-bit image.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "berth/types/image.hpp"

namespace berth {

/// How a camera's readings become metres, and which of them count.
struct DepthUnits {
  /// Of the number 1, in metres.
  double scale_m = 0.001;
  /// Added to each reading, once it is in metres.
  double offset_m = 0;
  /// Readings outside of these are none.
  double near_m = 0;
  double far_m = std::numeric_limits<double>::infinity();
};

/// No depth camera reads as far: drivers and simulators say so where they have no reading.
inline constexpr float kMostReading_m = 65.535F;

/// NaN unless it is a reading above 0, below kMostReading_m and between near and far.
inline float reading_or_none(double depth_m, const DepthUnits& units) {
  const auto depth = static_cast<float>(depth_m);
  const bool valid = depth > 0 && depth < kMostReading_m &&
                     depth >= static_cast<float>(units.near_m) &&
                     depth <= static_cast<float>(units.far_m);
  return valid ? depth : kNoDepth;
}

/// The number 0 is no reading, and so is the greatest, which many cameras write in its place.
inline float depth_of(std::uint16_t number, const DepthUnits& units) {
  return number == 0 || number == 65535
             ? kNoDepth
             : reading_or_none(number * units.scale_m + units.offset_m, units);
}

/// Rounded; NaN becomes 0. A depth is never 0, which would remove it: the least is 1. One beyond
/// 65534 is written as that: nearer to the camera than it is, never farther.
inline std::uint16_t number_of(float depth_m, double scale_m) {
  if (std::isnan(depth_m)) return 0;
  return static_cast<std::uint16_t>(std::clamp(std::round(depth_m / scale_m), 1.0, 65534.0));
}

}  // namespace berth
