// Inside the page of a calibration only: what it says of one camera.
#pragma once

#include <filesystem>
#include <string>

#include "berth/reports/calibration_report.hpp"

namespace berth::app {

/// A <section>; writes the camera's pictures to `folder`.
std::string camera_section(const std::filesystem::path& folder, const CalibrationReport& report,
                           std::size_t camera);

}  // namespace berth::app
