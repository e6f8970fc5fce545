// A real recording, and the same with its calibration a little wrong.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"
#include "lab/filter/expected_ranges.hpp"

namespace berth::lab {

/// One image with the robot where the calibration says that it is.
struct JudgedView {
  Camera camera;
  DepthImage depth_m;
  RobotImage robot;
  int link_count = 0;
  /// [i] is that of the link with the id i + 1.
  std::vector<ExpectedRange> expected;
};

struct JudgedRecording {
  std::string name;
  /// Draw by draw, frame by frame.
  std::vector<JudgedView> views;
};

/// The recording in `folder` (scene.yaml, expected.tsv), `draws` times: the camera's pose off by 2
/// to 5 mm and 0.2 to 0.5 degrees, each joint by at most 0.1 degrees, drawn from seeds 1 to
/// `draws`; as it is where `draws` is 0. Throws std::runtime_error for a bad file.
JudgedRecording load_recording(const std::filesystem::path& folder, int draws);

}  // namespace berth::lab
