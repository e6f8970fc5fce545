// Inside the page of a calibration only: the pictures and what their colours mean.
#pragma once

#include <string>

#include "apps/berth/calibration_frames.hpp"
#include "berth/calibration/calibrate.hpp"

namespace berth::app {

/// `found` reports whether there is an after.
std::string frames_html(const CalibrationCamera& source, const CameraCalibration& found,
                        const CalibrationFrames& frames);

}  // namespace berth::app
