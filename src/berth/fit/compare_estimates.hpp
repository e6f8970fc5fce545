// For watch/ and calibration/: what an estimate means for the robot in the images.
#pragma once

#include <vector>

#include "berth/fit/frame_drawer.hpp"

namespace berth {

/// How far readings lie from the model's surface, along the optical axis, where they are the
/// robot's (within 10 cm). NaN where there is none.
struct ResidualSpread {
  double median_m = 0;
  double p90_m = 0;
  double p99_m = 0;
};

/// How far the robot's visible points lie apart between two estimates, as each camera sees them: a
/// mean for each camera. NaN where a camera sees no robot.
std::vector<double> displacement_m(FrameDrawer& drawer, int step, const CalibrationEstimate& a,
                                   const CalibrationEstimate& b);

/// The mean depth of the robot's pixels where an estimate puts it, for each camera. NaN where a
/// camera sees no robot.
std::vector<double> robot_depth_m(FrameDrawer& drawer, int step,
                                  const CalibrationEstimate& estimate);

/// |reading - model| where readings are the robot's, for each camera.
std::vector<ResidualSpread> residuals(FrameDrawer& drawer, const CalibrationEstimate& estimate);

}  // namespace berth
