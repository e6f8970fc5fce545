#pragma once

#include "berth/sensor/settings.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The depth that HolePolicy::obstacle gives a pixel: nearer than any depth camera measures, so
/// that everything behind it counts as hidden, and still more than 0 in a PNG of millimetres.
inline constexpr float kHoleDepth_m = 0.01F;

/// Gives the holes a depth by the policy, and the fate `hole`: `no_reading` pixels that the model,
/// robot or environment, does not cover. Only adds obstacles.
void fill_holes(HolePolicy policy, const RobotImage& robot, ObstacleImage& out);

}  // namespace berth
