// Inside the page of a calibration only: its parts.
#pragma once

#include <filesystem>
#include <string>

#include "apps/berth/calibration_frames.hpp"
#include "berth/reports/calibration_report.hpp"

namespace berth::app {

/// A <section>; writes the camera's pictures to `folder`.
std::string camera_section(const std::filesystem::path& folder, const CalibrationReport& report,
                           std::size_t camera);

/// The pictures and what their colours mean. `found` reports whether there is an after.
std::string frames_html(const CalibrationCamera& source, const CameraCalibration& found,
                        const CalibrationFrames& frames);

/// What the robot carries: a section, and a picture of each image of each camera in `folder`; empty
/// where nothing was found and nothing hindered. Throws std::runtime_error where a picture cannot
/// be drawn or written.
std::string attached_section(const std::filesystem::path& folder, const CalibrationReport& report);

/// What the cameras detect: sentences, and the map in slices, the lowest one first; empty where
/// nobody measured it.
std::string detection_section(const DetectionMap& map);

}  // namespace berth::app
