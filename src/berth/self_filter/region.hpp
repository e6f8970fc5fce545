// Inside self_filter/ only.
#pragma once

#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Gives the obstacles where `region` shows nothing the fate `outside_region`.
void ignore_outside(const RobotImage& region, ObstacleImage& out);

}  // namespace berth
