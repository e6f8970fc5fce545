// The frames of a calibration as pictures, and their residuals as a histogram.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/berth/residual_histogram.hpp"
#include "berth/reports/calibration_coverage.hpp"
#include "berth/reports/calibration_report.hpp"

namespace berth::app {

/// One picture of a frame.
struct FramePicture {
  /// A file's name in the page's folder; empty: the joints are not known at the clock that was
  /// found, or the pose that was found is refused.
  std::string file;
  /// Pixels beside the robot that are like it, see flying_pixels_at_robot().
  int flying_px = 0;
};

struct FramePictures {
  /// CalibrationFrame::number.
  int number = 0;
  FramePicture before;
  FramePicture after;
};

struct CalibrationFrames {
  ResidualHistogram before;
  ResidualHistogram after;
  std::vector<FramePictures> pictures;
};

/// The most frames of one camera that are drawn.
inline constexpr std::size_t kMostPictures = 6;

/// Which frames are drawn: spread over all, and the one that agrees worst. Increasing.
std::vector<std::size_t> frames_to_draw(const CalibrationCamera& camera,
                                        const CalibrationCoverage& coverage);

/// Writes the pictures of one camera to `folder` as PNG files. Throws std::runtime_error where one
/// cannot be drawn or written.
CalibrationFrames write_calibration_frames(const std::filesystem::path& folder,
                                           const CalibrationReport& report, std::size_t camera,
                                           const CalibrationCoverage& coverage);

}  // namespace berth::app
