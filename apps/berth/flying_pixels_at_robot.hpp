#pragma once

#include "berth/fit/calibration_data.hpp"
#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth::app {

/// The pixels beside the robot's outline, within 5 cm at its depth, whose readings are like the
/// robot's there (within 5 cm) and unlike those of most other frames at that pixel: flying pixels
/// that the camera draws, or a robot that is not where its model is. 1 for such a pixel.
Image<std::uint8_t> flying_pixels_at_robot(const CalibrationCamera& camera, std::size_t frame,
                                           const RobotImage& robot);

}  // namespace berth::app
