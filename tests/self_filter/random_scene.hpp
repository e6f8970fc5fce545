#pragma once

#include <cstdint>

#include "berth/self_filter/settings.hpp"
#include "sim/random_images.hpp"

namespace berth {

/// What a self filter is given.
struct RandomScene {
  Camera camera;
  RobotImage robot;
  DepthImage sensor_depth_m;
  SelfFilterSettings settings;
};

/// Depends on the seed alone: the scene of random_images with the sensor's own view of the robot
/// put back, a little displaced, with noise; flying, mixed pixels and holes beside it; now and then
/// environment, a robot that touches the image's border, a tight extent or none. Every setting
/// varies, and is off now and then.
RandomScene random_scene(std::uint32_t seed);

}  // namespace berth
