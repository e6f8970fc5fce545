#pragma once

#include "tests/render/small_robot.hpp"

namespace berth {

/// Links with tens of thousands of triangles of all sizes, before, around and behind a camera that
/// stands at the robot's base.
struct CrowdedRobot {
  RobotModel model;
  RobotPose pose;

  explicit CrowdedRobot(std::uint32_t seed);
};

}  // namespace berth
