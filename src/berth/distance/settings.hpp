#pragma once

#include <optional>

namespace berth {

/// What is asked of every method of the distance stage.
struct DistanceSettings {
  /// L: a distance above it is no answer. The half side of the region of surveillance (Hirt 2.2.3).
  double range_m = 1.0;
  /// Whether evaluate() fills LinkDistance::mean_direction_C (Hirt 2.2.5).
  bool mean_direction = true;
  /// `exact` may stop as soon as no pair of a link can be closer than the one found by more than
  /// this; 0 finds the closest.
  double tolerance_m = 0;
  /// `exact` stops this many microseconds after it was called, mean directions not counted, with
  /// what it has found by then; the first pair of tiles of each link is always searched.
  std::optional<double> deadline_us = std::nullopt;
};

/// Throws std::invalid_argument, naming key and value, unless range_m is finite and above 0,
/// tolerance_m finite and at least 0, deadline_us at least 0.
void validate(const DistanceSettings& settings);

}  // namespace berth
