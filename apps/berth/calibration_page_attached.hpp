// What the robot carries, on the page of a calibration.
#pragma once

#include <filesystem>
#include <string>

#include "berth/reports/calibration_report.hpp"

namespace berth::app {

/// Its section, and a picture of each image of each camera in `folder`; empty where nothing was
/// found and nothing hindered. Throws std::runtime_error where a picture cannot be drawn or
/// written.
std::string attached_section(const std::filesystem::path& folder, const CalibrationReport& report);

}  // namespace berth::app
