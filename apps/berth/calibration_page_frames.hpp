// Inside the page of a teach-in only: the pictures and what their colours mean.
#pragma once

#include <string>

#include "apps/berth/calibration_frames.hpp"
#include "berth/calibration/teach_in.hpp"

namespace berth::app {

std::string frames_html(const TeachInCamera& source, const CalibrationFrames& frames);

}  // namespace berth::app
