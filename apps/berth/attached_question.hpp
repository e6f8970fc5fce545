// Whether what the robot carries is a part of it.
#pragma once

#include <functional>

#include "apps/berth/arguments.hpp"
#include "apps/support/progress_bar.hpp"
#include "berth/calibration/attached_parts.hpp"

namespace berth::app {

/// The answer that was chosen, or that is given at the terminal. Where there is none, no: what is
/// taken by mistake is never seen again as an obstacle, what is left out by mistake shows as one.
std::function<bool(const AttachedPart&, const CalibrationResult&)> attached_question(
    AttachedChoice choice, const ProgressBar& progress);

}  // namespace berth::app
