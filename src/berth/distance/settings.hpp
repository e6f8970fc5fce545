#pragma once

namespace berth {

/// What is asked of every method of the distance stage.
struct DistanceSettings {
  /// L: a distance above it is no answer. The half side of the region of surveillance (Hirt 2.2.3).
  double range_m = 1.0;
  /// Whether evaluate() fills LinkDistance::mean_direction_C (Hirt 2.2.5).
  bool mean_direction = true;
};

/// Throws std::invalid_argument, naming key and value, unless range_m is finite and above 0.
void validate(const DistanceSettings& settings);

}  // namespace berth
