#pragma once

#include "berth/distance/settings.hpp"
#include "thesis/surveillance_settings.hpp"

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

/// What the methods have of their own.
struct ImageSettings {
  SurveillanceSettings surveillance = {};
  LatticeSettings lattice = {};

  bool operator==(const ImageSettings&) const = default;
};

/// Settings of every method. `mean_direction` is LinkDistance's, min_seen_share has no meaning
/// here, and without tolerance_m `exact` goes on until it knows the least distance.
struct ImageDistanceSettings : DistanceSettings, ImageSettings {
  bool operator==(const ImageDistanceSettings&) const = default;
};

/// The steps and radii of LatticeSettings lie between 1 and this.
inline constexpr int kMaxLatticePx = 65536;
/// And tile_px between 1 and this.
inline constexpr int kMaxTilePx = 64;

/// A setting of some methods alone.
struct MethodSetting : Setting {
  /// With blanks between; empty: all.
  std::string_view methods = {};
};

/// The list of these settings. visit(MethodSetting, value).
template <SettingsOf<ImageSettings> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  constexpr Domain kPixels{.least = 1, .most = kMaxLatticePx};
  const auto searched = [&](std::string_view name, std::string_view sentence, auto& value) {
    visit(MethodSetting{{name, {}, sentence}, "brute_force lattice"}, value);
  };
  searched("region",
           "where obstacles of a robot pixel are looked for; without it image for brute_force, "
           "cube_projection for lattice",
           s.surveillance.region);
  searched("depth_interval",
           "whether obstacles in front of the cube around a robot pixel count: in gray_area they "
           "do",
           s.surveillance.depth_interval);
  searched("search_pattern", "the order of obstacle pixels", s.surveillance.search_pattern);
  searched("shrinking", "whether the region shrinks with a link's closest pair",
           s.surveillance.shrinking);
  visit(MethodSetting{{"step_x", kPixels, "tries every Nth column of obstacle pixels"},
                      "lattice gl_lattice gl_hybrid"},
        s.lattice.step_x);
  visit(MethodSetting{{"step_y", kPixels, "tries every Nth row of obstacle pixels"},
                      "lattice gl_lattice gl_hybrid"},
        s.lattice.step_y);
  visit(MethodSetting{{"initial_grid_radius_px", kPixels,
                       "radius around the robot pixels that are tried first"},
                      "lattice gl_hybrid"},
        s.lattice.initial_grid_radius_px);
  visit(MethodSetting{{"final_grid_radius_px", kPixels,
                       "radius within which all robot pixels are tried last"},
                      "lattice gl_lattice gl_hybrid"},
        s.lattice.final_grid_radius_px);
  visit(MethodSetting{{"tile_px",
                       {.least = 1, .most = kMaxTilePx},
                       "size of the tiles of which one robot pixel each is tried first"},
                      "gl_lattice"},
        s.lattice.tile_px);
}

/// The list of these settings, of the first struct those that mean something here.
template <SettingsOf<ImageDistanceSettings> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  using Distance =
      std::conditional_t<std::is_const_v<Settings>, const DistanceSettings, DistanceSettings>;
  using Images = std::conditional_t<std::is_const_v<Settings>, const ImageSettings, ImageSettings>;
  visit_settings(static_cast<Distance&>(s), [&](const Setting& setting, auto& value) {
    if (setting.name == "min_seen_share") return;
    const bool may_end_early = setting.name == "tolerance_m" || setting.name == "deadline_us";
    visit(MethodSetting{setting, may_end_early ? "exact" : ""}, value);
  });
  visit_settings(static_cast<Images&>(s), visit);
}

/// Throw std::invalid_argument, naming key and value, unless each lies in its domain, and the final
/// radius is at most the initial one.
void validate(const ImageSettings& settings);
void validate(const ImageDistanceSettings& settings);

}  // namespace berth
