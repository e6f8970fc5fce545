#include "berth/reports/calibration_report.hpp"

namespace berth {

CalibrationReport report_of(const SceneCalibrationData& material,
                            const SceneCalibration& calibration, bool corrects_depth) {
  return {&material.calibration_data, &calibration.found,   calibration.filters,  corrects_depth,
          calibration.warnings,       calibration.attached, calibration.detection};
}

int frames_used(const CalibrationReport& report) {
  std::size_t count = 0;
  for (const CameraCalibration& camera : report.result->cameras) count += camera.frames.size();
  return static_cast<int>(count);
}

}  // namespace berth
