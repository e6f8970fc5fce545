// The self filter's settings for one camera, from what a calibration left unexplained.
#pragma once

#include <string>
#include <vector>

#include "berth/calibration/calibrate.hpp"
#include "berth/fit/calibration_data.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/sensor/settings.hpp"

namespace berth {

/// One setting that calibration proposes.
struct ProposedSetting {
  /// A key of SelfFilterSettings or SensorSettings.
  std::string key;
  double value = 0;
  /// The figure that it was taken from, as a sentence.
  std::string why;
};

/// What stands out of the image with the proposed settings, far from the robot, at one depth.
struct SmallestObstacle {
  double depth_m = 0;
  /// A rod of 30 cm and a fingertip of 7 cm, upright: the least width of which at least half is
  /// kept in nine of ten places; NaN where 3 cm are swallowed, too, or no image has room for them.
  double rod_width_m = 0;
  double finger_width_m = 0;
};

/// Settings for one camera, and what they do to its own images.
struct FilterProposal {
  std::vector<ProposedSetting> self_filter;
  std::vector<ProposedSetting> sensor;
  /// The camera's present settings with those.
  SelfFilterSettings self_filter_settings;
  SensorSettings sensor_settings;
  /// Readings of the robot lie behind the model by this, in the median.
  double bias_m = 0;
  /// Readings that the settings leave, within 10 cm of the robot, where no other frame shows the
  /// same: pixels of all frames, and of the largest blob.
  int leftover_px = 0;
  int largest_leftover_px = 0;
  std::vector<SmallestObstacle> smallest;
  /// How near to the robot's outline, at its own depth, a rod of 1 cm may stand without being taken
  /// for the robot; NaN where even 15 cm are too near, or no image has room.
  double rod_gap_m = 0;
};

/// For camera number `camera` of the calibration, at the pose, clock and joints of `found`.
/// `self_filter` and `sensor` are its present settings: what is not proposed stays as it is there.
/// With `corrects_depth` readings are taken as `found` corrects them.
FilterProposal propose_filter(const CalibrationData& calibration_data, std::size_t camera,
                              const CalibrationResult& found, bool corrects_depth,
                              const SelfFilterSettings& self_filter, const SensorSettings& sensor);

}  // namespace berth
