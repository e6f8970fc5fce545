#pragma once

#include <optional>

#include "berth/distance/surveillance_settings.hpp"
#include "berth/types/setting.hpp"

namespace berth {

/// For `lattice`, `gl_hybrid` and `gl_lattice` (Hirt 3.1.2, 3.1.3). Of what the thesis advises
/// (3.2), the defaults are the careful end: larger steps and a larger first radius save time and
/// miss more.
struct LatticeSettings {
  /// Of a robot pixel's region only every step_x-th column and step_y-th row is tried, except in
  /// the last step.
  int step_x = 1;
  int step_y = 1;
  /// Radius of the circles around the points of a link's first lattice; not in gl_lattice.
  int initial_grid_radius_px = 40;
  /// Radius of the finest circles, in gl_lattice the size of the finest tiles; around the closest
  /// point, of the last step too.
  int final_grid_radius_px = 2;
  /// gl_lattice: size of the tiles of the first lattice.
  int tile_px = 16;

  bool operator==(const LatticeSettings&) const = default;
};

/// What is asked of every method of the distance stage.
struct DistanceSettings {
  /// L: a distance above it is no answer. The half side of the region of surveillance (Hirt 2.2.3).
  double range_m = 1.0;
  /// Whether evaluate() fills LinkDistance::mean_direction_C (Hirt 2.2.5).
  bool mean_direction = true;
  /// `exact` and `mesh` may stop as soon as no pair of a link can be closer than the one found by
  /// more than this. Nothing: 0 for exact, which finds the closest, and 1 mm for mesh.
  std::optional<double> tolerance_m = std::nullopt;
  /// `exact` and `mesh` stop this many microseconds after it was called, mean directions not counted, with
  /// what it has found by then; the first pair of tiles of each link is always searched.
  std::optional<double> deadline_us = std::nullopt;
  /// `mesh`: a link of whose surface the cameras see a smaller share is LinkStatus::not_seen.
  double min_seen_share = 0.02;
  SurveillanceSettings surveillance = {};
  LatticeSettings lattice = {};

  bool operator==(const DistanceSettings&) const = default;
};

/// The steps and radii of LatticeSettings lie between 1 and this.
inline constexpr int kMaxLatticePx = 65536;
/// And tile_px between 1 and this.
inline constexpr int kMaxTilePx = 64;

/// The list of these settings.
template <SettingsOf<DistanceSettings> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  constexpr Domain kPixels{.least = 1, .most = kMaxLatticePx};
  visit({"range_m", kAboveZero, "distances are looked for up to here"}, s.range_m);
  visit({"mean_direction", {}, "whether to give the mean direction of what is near each link"},
        s.mean_direction);
  visit({"tolerance_m", kNotNegative,
         "the search may stop once a link's distance is known to this; without it 0.001 for mesh, "
         "0 for exact",
         "mesh exact"},
        s.tolerance_m);
  visit({"deadline_us", {.may_be_infinite = true},
         "the search stops after so many microseconds, mean directions not counted, and tells what "
         "it knows by then: distance and lower bound",
         "mesh exact"},
        s.deadline_us);
  visit({"min_seen_share", {.most = 1},
         "a link of whose surface the cameras see a smaller share is not_seen", "mesh"},
        s.min_seen_share);
  visit({"region", {},
         "where obstacles of a robot pixel are looked for; without it image for brute_force, "
         "cube_projection for lattice",
         "brute_force lattice"},
        s.surveillance.region);
  visit({"depth_interval", {},
         "whether obstacles in front of the cube around a robot pixel count: in gray_area they do",
         "brute_force lattice"},
        s.surveillance.depth_interval);
  visit({"search_pattern", {}, "the order of obstacle pixels", "brute_force lattice"},
        s.surveillance.search_pattern);
  visit({"shrinking", {}, "whether the region shrinks with a link's closest pair",
         "brute_force lattice"},
        s.surveillance.shrinking);
  visit({"step_x", kPixels, "tries every so many columns of obstacle pixels",
         "lattice gl_lattice gl_hybrid"},
        s.lattice.step_x);
  visit({"step_y", kPixels, "tries every so many rows of obstacle pixels",
         "lattice gl_lattice gl_hybrid"},
        s.lattice.step_y);
  visit({"initial_grid_radius_px", kPixels, "radius around the robot pixels that are tried first",
         "lattice gl_hybrid"},
        s.lattice.initial_grid_radius_px);
  visit({"final_grid_radius_px", kPixels, "radius within which all robot pixels are tried last",
         "lattice gl_lattice gl_hybrid"},
        s.lattice.final_grid_radius_px);
  visit({"tile_px", {.least = 1, .most = kMaxTilePx},
         "size of the tiles of which one robot pixel each is tried first", "gl_lattice"},
        s.lattice.tile_px);
}

/// Throws std::invalid_argument, naming key and value, unless range_m is finite and above 0,
/// tolerance_m finite and at least 0, deadline_us at least 0, steps and radii of the lattice from 1
/// to kMaxLatticePx, its tiles from 1 to kMaxTilePx, and the final radius at most the initial one.
void validate(const DistanceSettings& settings);

}  // namespace berth
