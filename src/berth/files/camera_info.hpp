#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "berth/types/camera.hpp"

namespace berth {

/// What a camera_info says of the images that come with it.
struct CameraInfo {
  /// Their pinhole camera; where they are not rectified, that of the lens's middle.
  Camera camera;
  /// They are as this lens made them.
  std::optional<Lens> lens;
};

/// A ROS camera_info file (YAML): image_width, image_height, camera_matrix, distortion_model,
/// distortion_coefficients, projection_matrix; or a CameraInfo message as ROS prints it: width,
/// height, k (K), distortion_model, d (D), p (P), binning, roi. Other keys are not looked at. Of
/// rectified images P counts, or K where there is no P; of others K and D. Without a word of the
/// caller images are rectified if each coefficient is 0. Throws std::runtime_error with file, line,
/// key, value and what was expected; where there is distortion, and the caller said nothing, too.
CameraInfo read_camera_info(const std::filesystem::path& file,
                            std::optional<bool> is_rectified = {});

/// The same for a text that stands nowhere; messages call it `name`.
CameraInfo parse_camera_info(const std::filesystem::path& name, const std::string& text,
                             std::optional<bool> is_rectified);

}  // namespace berth
