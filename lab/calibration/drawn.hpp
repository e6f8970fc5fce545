#pragma once

#include <vector>

#include "lab/calibration/recordings.hpp"
#include "lab/trust/trial_robots.hpp"
#include "sim/drawn_calibration_data.hpp"

namespace berth::lab {

struct DrawnTrials {
  sim::DrawnCalibrationSettings drawn;
  StartErrors start;
  /// Of each robot.
  int seeds = 5;
  bool joint_zeros = false;
  bool prints_each = false;
};

/// Prints how far what calibration finds is from the truth: one row of a Markdown table.
void measure_drawn(const std::vector<TrialRobot>& robots, const DrawnTrials& trials);
extern const char* const kDrawnHeading;

}  // namespace berth::lab
