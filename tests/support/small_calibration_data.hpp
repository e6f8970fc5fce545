// A calibration of a few pixels: an arm of two boxes before a wall, seen by one camera whose pose
// the scene has wrong and a calibration, made up, has right.
#pragma once

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

}  // namespace berth::testing
