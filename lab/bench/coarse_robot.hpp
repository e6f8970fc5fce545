#pragma once

#include "berth/robot/robot_model.hpp"

namespace berth::lab {

/// The robot with its collision shapes made coarse (4 500 triangles of the bundled one),
/// then each triangle in parts * parts: the same surface for all parts. Throws as load_robot does.
RobotModel coarse_robot(RobotSettings robot, int parts);

}  // namespace berth::lab
