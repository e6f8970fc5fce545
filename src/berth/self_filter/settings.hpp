#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "berth/types/robot_image.hpp"
#include "berth/types/setting.hpp"

namespace berth {

/// How much of the sensor's image counts as the robot itself. The defaults are those that work on
/// real recordings of two robots and two kinds of camera.
struct SelfFilterSettings {
  /// A reading belongs to the robot unless it is nearer than the model by more than
  /// tolerance_m + tolerance_per_m2 z^2 (z = the model's depth): calibration, then noise.
  double tolerance_m = 0.05;
  double tolerance_per_m2 = 0;
  /// The silhouette grows by this length at the robot's depth, on all sides in the image.
  double padding_m = 0.02;
  /// Padding of single links: link_padding_m[i] is that of the link with the id i + 1; where the
  /// list ends or holds NaN, padding_m. Environment pads around its outline only, and has no flying
  /// patches: a thing that stands on a table stays.
  std::vector<double> link_padding_m;
  /// Padding takes what lies behind the robot's outline by no more than this: a camera that smooths
  /// draws flying pixels from the arm to what is behind it. Farther behind it takes only what is on
  /// no surface (discs.hpp), as mixed pixels are: a thing that is seen there is one. No setting:
  /// nobody can choose it.
  double padding_depth_m = 0.3;
  /// t: what stands off the robot's or environment's surface in space by more than this, times
  /// surface_growth(z), is a thing that lies on it (surface_things.hpp); none: what the image's own
  /// readings of these surfaces say; 0 turns the rule off.
  std::optional<double> surface_tolerance_m = std::nullopt;
  /// A camera that smooths draws flying pixels from the robot's outline. Pieces of readings that
  /// hang on the robot's own readings and lie wholly where padding of this length would reach are
  /// judged by their rim (flying_patches.hpp); 0 turns the rule off.
  double flying_patch_radius_m = 0.07;
  /// The robot-shaped region of surveillance (Hirt 3.1.1): obstacles that are not seen through the
  /// robot enlarged this many times (robot_region) are **ignored**, however near they are in space;
  /// the thesis's picture uses 6. It is uneven: wide around thick links, narrow around thin ones,
  /// where an obstacle that is ignored makes a distance too large. At other joint angles than those
  /// of the exposure it stays where it was. 0 turns it off, else it is at least 1. No setting:
  /// `berth evaluate` has it as an option.
  double robot_region_scale = 0;

  double padding_of(LinkId id) const {
    if (id == kEnvironmentLink) return padding_m;
    const std::size_t i = static_cast<std::size_t>(id) - 1;
    return i < link_padding_m.size() && !std::isnan(link_padding_m[i]) ? link_padding_m[i]
                                                                       : padding_m;
  }
};

/// The list of these settings but link_padding_m, which goes by link.
template <SettingsOf<SelfFilterSettings> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  visit({"tolerance_m", kNotNegative,
         "a reading is the robot's unless it is nearer than the model by more than tolerance_m + "
         "tolerance_per_m2 z²"},
        s.tolerance_m);
  visit({"tolerance_per_m2", kNotNegative, "part of the tolerance that grows with z²"},
        s.tolerance_per_m2);
  visit({"padding_m", kNotNegative,
         "a reading beside the robot within this length is taken for the robot too"},
        s.padding_m);
  visit({"surface_tolerance_m", kNotNegative,
         "what stands off a surface by more than this (at 1 m) in space lies on it, and is an "
         "obstacle; none: 0.01 to 0.025, as the camera's own readings scatter; 0 is off"},
        s.surface_tolerance_m);
  visit({"flying_patch_radius_m", kNotNegative,
         "a piece that touches the robot's own readings and stays within this distance of the "
         "robot is unknown unless its rim shows that it is a thing; 0 is off"},
        s.flying_patch_radius_m);
}

/// Throws std::invalid_argument that names key, value and what was expected.
void validate(const SelfFilterSettings& settings);

/// Throws std::invalid_argument unless a region is given exactly where robot_region_scale asks for
/// one.
void require_region(const SelfFilterSettings& settings, bool is_given);

/// A reading belongs to a surface of depth z unless it is nearer than z by more than
/// constant_m + per_m2 z^2.
struct Tolerance {
  float constant_m;
  float per_m2;

  /// The least reading that belongs to a surface of this depth; pixels-inl.hpp has it in vectors,
  /// with the same operations.
  float least_reading_m(float z_m) const { return z_m - (constant_m + per_m2 * z_m * z_m); }

  /// The greatest reading that may be on a surface of this depth; a deeper one lies behind it.
  float greatest_reading_m(float z_m) const { return z_m + (constant_m + per_m2 * z_m * z_m); }
};

inline Tolerance tolerance_of(const SelfFilterSettings& settings) {
  return {static_cast<float>(settings.tolerance_m), static_cast<float>(settings.tolerance_per_m2)};
}

}  // namespace berth
