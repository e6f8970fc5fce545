#pragma once

#include <cstdint>

#include "berth/scene/open_scene.hpp"

namespace berth::lab {

/// One image of a camera, in which somebody hides up to 90 % of the robot.
struct HiddenImage {
  /// Which one it was before.
  std::size_t frame = 0;
  DepthImage depth_m;
  /// Where the robot is believed to be.
  RobotImage robot;
};

HiddenImage hidden_image(const OpenCamera& camera, std::uint32_t seed);

}  // namespace berth::lab
