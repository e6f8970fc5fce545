// What the frames of a calibration show of the robot, and so what more frames should show.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "berth/reports/calibration_report.hpp"

namespace berth {

/// The robot in one image, as it was found.
struct FrameCoverage {
  /// CalibrationFrame::number.
  int number = 0;
  /// Pixels of the robot, those of them with a reading, and those whose reading is the robot's
  /// (within 10 cm).
  int robot_px = 0;
  int reading_px = 0;
  int fitting_px = 0;
  /// Of |reading - model| where readings are the robot's; NaN where none is.
  double median_residual_m = std::numeric_limits<double>::quiet_NaN();
};

/// The middle of what is seen, without the outermost 2 % on each side; NaN where there is none.
struct CoveredRange {
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

struct CalibrationCoverage {
  /// Those whose joints are known at the clock that was found.
  std::vector<FrameCoverage> frames;
  /// frames_with_link[i]: how many frames show at least 100 px of the link with the id i + 1 that
  /// have its readings.
  std::vector<int> frames_with_link;
  /// Where in the images the robot's readings are: 0 is the left or upper edge, 1 the other one.
  CoveredRange across;
  CoveredRange down;
  CoveredRange depth_m;
  double median_depth_m = std::numeric_limits<double>::quiet_NaN();
  /// joint_range[j]: how far joint j of RobotModel::joints moved over all frames, rad or m.
  std::vector<double> joint_range;
};

CalibrationCoverage coverage_of(const CalibrationReport& report, std::size_t camera);

/// What to do next for a better calibration of one camera: sentences for people, the most needed
/// first. Empty: nothing is left to do.
std::vector<std::string> calibration_advice(const CalibrationReport& report, std::size_t camera,
                                            const CalibrationCoverage& coverage);

}  // namespace berth
