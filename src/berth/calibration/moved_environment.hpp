#pragma once

#include <vector>

#include "berth/calibration/calibrate.hpp"

namespace berth {

/// Something stood elsewhere in the next frame.
struct EnvironmentChange {
  std::string camera;
  /// Numbers of two frames that follow each other among those that were used.
  int before = 0;
  int after = 0;
  /// Of the pixels beside the robot that have a reading in both.
  double share = 0;
};

/// The changes by which a calibration is disturbed: more than kMostChanged of the pixels that lie
/// 10 cm and more beside the robot in both frames differ by more than 10 cm (times z^2 beyond 1 m).
/// None of a camera that moves with the robot: all that is beside the robot moves before it.
std::vector<EnvironmentChange> moved_environment(const CalibrationData& calibration_data,
                                                 const CalibrationResult& found);

inline constexpr double kMostChanged = 0.02;

}  // namespace berth
