#pragma once

#include <algorithm>

#include "berth/types/robot_image.hpp"

namespace berth {

/// Readings at the robot's depth to the right of it, as a camera that smooths makes them: they end
/// in a hole. In each `step`-th row: alone they are crumbs. For images of the bundled scene.
inline void draw_flying_pixels(const RobotImage& robot, DepthImage& depth_m, int step = 1) {
  for (int v = 100; v < 300; v += step) {
    for (int u = robot.link_id.width() - 40; u > 0; --u) {
      const LinkId id = robot.link_id(u, v);
      if (id == kNoLink || id == kEnvironmentLink) continue;
      std::fill_n(depth_m.row(v) + u + 1, 12, robot.depth_m(u, v));
      std::fill_n(depth_m.row(v) + u + 13, 6, kNoDepth);
      break;
    }
  }
}

}  // namespace berth
