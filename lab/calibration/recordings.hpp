#pragma once

#include <filesystem>

namespace berth::lab {

/// How wrong the camera's pose is at the start.
struct StartErrors {
  double offset_m = 0.05;
  double angle_deg = 5;
  /// How many of the starts are judged by the recording's known distances.
  int judged = 1;
  /// Of the robot's middle, about.
  double robot_depth_m = 1.2;
};

/// Prints what calibration finds on a recording, from its own pose and from random starts.
void measure_recording(const std::filesystem::path& folder, const StartErrors& errors, int starts);

}  // namespace berth::lab
