#pragma once

#include <string>
#include <vector>

#include "berth/scene/calibration_report.hpp"
#include "berth/scene/teach_in_coverage.hpp"

namespace berth {

/// What to do next for a better calibration of one camera: sentences for people, the most needed
/// first. Empty: nothing is left to do.
std::vector<std::string> calibration_advice(const CalibrationReport& report, std::size_t camera,
                                            const TeachInCoverage& coverage);

}  // namespace berth
