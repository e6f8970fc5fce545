// A calibration of a few pixels: an arm of two boxes before a wall, seen by one camera whose pose
// the scene has wrong and a calibration, made up, has right.
#pragma once

#include <limits>
#include <memory>

#include "berth/reports/calibration_report.hpp"

namespace berth::testing {

class SmallCalibrationData {
 public:
  /// Each frame has the arm in another pose, turned by `step_rad`.
  explicit SmallCalibrationData(int frames = 5, double step_rad = 0.3);

  /// With pointers into this object.
  CalibrationReport report() const { return {&calibration_data, &result, {proposal}, false, {}}; }

  RobotModel model;
  CalibrationCamera camera;
  /// A sample each second; joint_1 turns by 1 rad/s and joint_2 stands.
  std::unique_ptr<JointTrajectory> joints;
  CalibrationData calibration_data;
  /// The true pose, 20 mm beside the scene's.
  CalibrationResult result;
  FilterProposal proposal;

  CameraCalibration& found() { return result.cameras[0]; }
};

/// Four places in a row, the last one in no camera's view.
inline DetectionMap small_detection_map() {
  DetectionMap map{{{0, 0, 1}, 0.3}, 0.1, {}, {}, {}};
  for (const double x_m : {0.0, 0.1, 0.2, 0.3}) map.places_B_m.emplace_back(x_m, 0, 1);
  map.cell.least_m = {0.02, 0.03, 0.06, std::numeric_limits<double>::quiet_NaN()};
  map.cameras = {{{0.04, 0.02, std::numeric_limits<double>::infinity(), map.cell.least_m[3]}}};
  return map;
}

}  // namespace berth::testing
