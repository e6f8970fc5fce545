// One frame of a calibration with the robot's model on it.
#pragma once

#include <string>

#include "apps/berth/picture_pixels.hpp"
#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth::app {

/// All of one size.
struct CalibrationPicture {
  DepthView sensor_depth_m;
  /// Of the camera, so that all its pictures have the same greys.
  DepthTone tone;
  const RobotImage* robot = nullptr;
  /// Reading - model.
  DepthView residual_m;
  /// See flying_pixels_at_robot().
  ImageView<std::uint8_t> flying;
  /// The part that is shown.
  PixelRect part;
};

inline constexpr Rgb kFlyingPixelColor{0xF0, 0xE4, 0x42};
inline constexpr Rgb kOutlineColor{0x10, 0x10, 0x10};
/// Of the outline where there is no reading, which is dark.
inline constexpr Rgb kBlindOutlineColor{0xC8, 0xC8, 0xC8};

/// The bytes of a PNG: depth in dark grey, robot pixels in residual_color(), the model's outline,
/// flying. Small images are enlarged by a whole factor. Throws std::runtime_error where it cannot
/// be drawn.
std::string calibration_picture_png(const CalibrationPicture& picture);

/// The least rectangle that holds the robot; empty where none is seen.
PixelRect robot_rect(const Image<LinkId>& link_id);

}  // namespace berth::app
