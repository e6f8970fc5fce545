#include "berth/reports/calibration_report.hpp"

namespace berth {

int frames_used(const CalibrationReport& report) {
  std::size_t count = 0;
  for (const CameraCalibration& camera : report.result->cameras) count += camera.frames.size();
  return static_cast<int>(count);
}

}  // namespace berth
