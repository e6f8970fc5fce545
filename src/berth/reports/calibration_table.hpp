#pragma once

#include <string>

#include "berth/reports/calibration_report.hpp"

namespace berth {

/// The calibration for people: of each camera how far its view moved and how sure that is,
/// residuals before and after, clock, depth, the proposed settings and why, and what to do next.
/// Draws the robot into all frames.
std::string calibration_table(const CalibrationReport& report);

}  // namespace berth
