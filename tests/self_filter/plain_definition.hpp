#pragma once

#include "berth/self_filter/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The whole self filter by its definition, one rule after the other, pixel by pixel and pair by
/// pair, in double precision except where a rounding of the rules themselves matters. Slow.
ObstacleImage plain_self_filter(const Camera& camera, const DepthImage& sensor_depth_m,
                                const RobotImage& robot, const SelfFilterSettings& settings);

}  // namespace berth
