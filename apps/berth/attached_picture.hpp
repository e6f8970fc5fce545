// One image of a calibration with what the robot carries.
#pragma once

#include <string>

#include "apps/berth/picture_pixels.hpp"
#include "berth/types/robot_image.hpp"

namespace berth::app {

/// All of one size.
struct AttachedPicture {
  DepthView sensor_depth_m;
  DepthTone tone;
  /// With what it carries, whose ids are those above `bare_links`.
  const RobotImage* robot = nullptr;
  LinkId bare_links = 0;
};

inline constexpr Rgb kAttachedColor{0xE6, 0x7E, 0x22};
inline constexpr Rgb kBareRobotColor{0x4A, 0x90, 0xC8};

/// The bytes of a PNG: depth in grey, the robot over it, and what it carries with its outline.
/// Small images are enlarged by a whole factor. Throws std::runtime_error where it cannot be drawn.
std::string attached_picture_png(const AttachedPicture& picture);

}  // namespace berth::app
