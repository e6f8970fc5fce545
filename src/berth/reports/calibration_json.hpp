#pragma once

#include <string>

#include "berth/reports/calibration_report.hpp"

namespace berth {

/// The calibration as one line of JSON, schema berth/calibration/1, without a line break at its
/// end. Metres, seconds, radians and pixels, rounded to a millionth, quaternions to a thousandth of
/// that. What is not known is null: deviations of a pose that was refused, that of a clock that is
/// not determined, the comparison of halves with one frame, residuals of a robot that is not seen.
std::string calibration_json(const CalibrationReport& report);

}  // namespace berth
