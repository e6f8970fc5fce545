// A calibration as a page for a browser, with pictures of its frames before and after.
#pragma once

#include <filesystem>
#include <string>

#include "berth/reports/calibration_report.hpp"

namespace berth::app {

/// Writes `folder`/index.html and the pictures beside it; makes the folder where it is missing. The
/// page needs nothing else, no network either. It is written last, so that it is complete where it
/// is there. `title` says of what, such as the scene's file. Throws std::runtime_error where a file
/// cannot be written.
void write_calibration_page(const std::filesystem::path& folder, const std::string& title,
                            const CalibrationReport& report);

}  // namespace berth::app
