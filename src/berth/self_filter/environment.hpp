#pragma once

#include <cstddef>

#include "berth/types/robot_image.hpp"

namespace berth {

/// Leaves the links that are evaluated; what environment hides of them stays hidden.
inline void take_out_environment(RobotImage& robot) {
  for (std::size_t i = 0; i < robot.link_id.pixels().size(); ++i) {
    if (robot.link_id.pixels()[i] != kEnvironmentLink) continue;
    robot.link_id.pixels()[i] = kNoLink;
    robot.depth_m.pixels()[i] = kNoDepth;
  }
}

}  // namespace berth
