#pragma once

#include <string_view>

#include "berth/types/setting.hpp"

namespace berth {

/// Rules for the sensor's faults. Every rule but `phantom_radius_m` is off by default. Only
/// that and `speckle_px` ever drop anything; the background adds obstacles.
struct SensorSettings {
  /// Two readings of one surface at z m differ by no more than noise_m max(1, z^2). No setting:
  /// nobody can choose it.
  double noise_m = 0.02;
  /// Blobs of fewer pixels are dropped; 0 and 1 turn the rule off. A blob is joined by steps
  /// between neighbours (8) as those of one surface (joined.hpp). What is lost
  /// with it is what shows the camera less than speckle_px z^2 / (fx fy) m^2: 20 at 1.5 m with 600
  /// px is 1.3 cm^2, 60 is 3.8 cm^2; a fingertip of 15 x 70 mm has 10 cm^2.
  int speckle_px = 0;
  /// d: a reading that is alone in space, with fewer than a quarter of the readings within d that a
  /// ball of this diameter would show, at most 5, is dropped as speckle (drop_phantoms);
  /// 0 turns the rule off.
  double phantom_radius_m = 0.03;
  /// A pixel of the empty cell is known once this number of images agrees on it; 0 turns the rule
  /// off. What the robot hides of it stays an obstacle, and where it was read and nothing is read
  /// now, something is that gives no reading (find_holes()).
  int background_frames = 0;
  /// No background is learned where the robot is within this length in the image, at its depth. No
  /// setting: nobody can choose it.
  double background_clearance_m = 0.15;

  bool drops_speckle() const { return speckle_px > 1; }
  bool has_background() const { return background_frames > 0; }
  /// The key of the first of apply_sensor_rules()'s rules that is on; empty where all are off.
  std::string_view first_rule() const;
};

/// The list of these settings.
template <SettingsOf<SensorSettings> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  visit({"speckle_px", kNotNegative, "blobs of fewer pixels are dropped; 0 and 1 are off"},
        s.speckle_px);
  visit({"phantom_radius_m", kNotNegative,
         "a reading is dropped that has fewer others within this distance than a thing of this "
         "size shows, at most 5; 0 is off"},
        s.phantom_radius_m);
  visit({"background_frames", kNotNegative,
         "what this number of images of the empty cell agrees on stands where the robot hides it "
         "now, and something is where it cannot be read any more; 0 is off"},
        s.background_frames);
}

/// Throws std::invalid_argument that names key, value and what was expected.
void validate(const SensorSettings& settings);

}  // namespace berth
