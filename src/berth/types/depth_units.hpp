// Depths as 16-bit numbers: half of a float's memory, and twice as many in a vector.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "berth/types/image.hpp"

namespace berth {

/// A depth in units of 1/2048 m, which a float holds exactly. Depths are rounded down to them: what
/// is free gets less by that, and what a surface hides begins earlier, both by at most 0.5 mm.
using DepthUnits = std::uint16_t;
using UnitImage = Image<DepthUnits>;

inline constexpr float kUnitsPerMetre = 2048;
/// Nothing ends what is free, or there is no reading.
inline constexpr DepthUnits kEndlessUnits = 65535;
/// Just below 32 m; stands for all depths beyond.
inline constexpr DepthUnits kMostUnits = 65534;

/// Rounded down, and at least 0; kEndlessUnits for NaN.
inline DepthUnits units_of(float depth_m) {
  if (std::isnan(depth_m)) return kEndlessUnits;
  return static_cast<DepthUnits>(std::clamp(depth_m * kUnitsPerMetre, 0.0f, float(kMostUnits)));
}

/// Rounded up: for lengths that are subtracted from a depth.
inline DepthUnits units_up(double length_m) {
  return static_cast<DepthUnits>(std::clamp(std::ceil(length_m * kUnitsPerMetre), 0.0, 65535.0));
}

/// +inf for kEndlessUnits.
inline float in_metres(DepthUnits units) {
  return units == kEndlessUnits ? std::numeric_limits<float>::infinity() : units / kUnitsPerMetre;
}

/// Keeps the memory, and what is in it, where the size stays.
inline void set_size(int width, int height, UnitImage& image) {
  if (image.width() != width || image.height() != height) image.resize(width, height, 0);
}

}  // namespace berth
