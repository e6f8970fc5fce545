#pragma once

#include <string>
#include <vector>

#include "berth/reports/calibration_coverage.hpp"
#include "berth/reports/calibration_report.hpp"

namespace berth {

/// What to do next for a better calibration of one camera: sentences for people, the most needed
/// first. Empty: nothing is left to do.
std::vector<std::string> calibration_advice(const CalibrationReport& report, std::size_t camera,
                                            const CalibrationCoverage& coverage);

}  // namespace berth
