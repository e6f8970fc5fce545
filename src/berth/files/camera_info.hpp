#pragma once

#include <filesystem>

#include "berth/types/camera.hpp"

namespace berth {

/// The intrinsics of a ROS camera_info file (YAML): image_width, image_height, camera_matrix,
/// distortion_model, distortion_coefficients; or of a CameraInfo message as ROS prints it: width,
/// height, k (K), distortion_model, d (D), with neither binning nor a region. Other keys are not
/// looked at. Only rectified images make a pinhole camera: every distortion coefficient must be 0,
/// and the model one for which that means none. Throws std::runtime_error with file, line, key,
/// value and what was expected.
Camera read_camera_info(const std::filesystem::path& file);

}  // namespace berth
