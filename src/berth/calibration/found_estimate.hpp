// Inside calibration/ only.
#pragma once

#include "berth/calibration/calibrate.hpp"
#include "berth/fit/estimate.hpp"

namespace berth {

/// What was found of one camera, about where its calibration started. `one` has that camera alone.
/// The depth's error is left out, since it is not taken out of the images by itself.
inline CalibrationEstimate found_estimate(const CalibrationData& one,
                                          const CameraCalibration& found,
                                          const CalibrationResult& all) {
  CalibrationEstimate estimate;
  CameraEstimate& camera = estimate.cameras.emplace_back();
  camera.X_PC = found.X_PC;
  camera.clock_shift_s = found.clock_offset_s - one.cameras[0]->clock_offset_s;
  for (const MovableJoint& joint : one.model->joints) {
    const auto offset = all.joint_offsets.find(joint.name);
    estimate.joint_shift.push_back(offset == all.joint_offsets.end() ? 0 : offset->second);
  }
  return estimate;
}

}  // namespace berth
