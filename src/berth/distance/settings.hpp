#pragma once

#include <optional>

#include "berth/distance/surveillance_settings.hpp"

namespace berth {

/// For `lattice` (Hirt 3.1.2). Of what the thesis advises (3.2), the defaults are the careful end:
/// larger steps and a larger first radius save time and miss more.
struct LatticeSettings {
  /// Of a robot pixel's region only every step_x-th column and step_y-th row is tried, except in
  /// the last step.
  int step_x = 1;
  int step_y = 1;
  /// Radius of the circles around the points of a link's first lattice.
  int initial_grid_radius_px = 40;
  /// Radius of the finest circles; around the closest point, of the last step too.
  int final_grid_radius_px = 2;
};

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
  SurveillanceSettings surveillance = {};
  LatticeSettings lattice = {};
};

/// The steps and radii of LatticeSettings lie between 1 and this.
inline constexpr int kMaxLatticePx = 65536;

/// Throws std::invalid_argument, naming key and value, unless range_m is finite and above 0,
/// tolerance_m finite and at least 0, deadline_us at least 0, steps and radii of the lattice from 1
/// to kMaxLatticePx, and the final radius at most the initial one.
void validate(const DistanceSettings& settings);

}  // namespace berth
