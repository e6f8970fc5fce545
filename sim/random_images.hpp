#pragma once

#include <cstdint>

#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth::sim {

/// A robot image and an obstacle image without a robot or a world behind them, for tests and
/// benchmarks of the distance stage.
struct ImagePair {
  Camera camera;
  RobotImage robot;
  DepthImage obstacle_depth_m;
  int link_count = 0;
};

/// Images of the given size without any pixel set, and a plain camera.
ImagePair empty_images(int width, int height, int link_count);

/// A scene that depends on its arguments alone: behind all a tilted plane, before it balls and
/// boxes with noise and dropouts; a chain of `link_count` thick strips for a robot, which the
/// obstacle image has a hole for, except where an obstacle is nearer. About 8 % of the pixels show
/// the robot. Intrinsics, principal point (now and then outside of the image) and all depths vary
/// with the seed.
ImagePair random_images(std::uint32_t seed, int width, int height, int link_count);

}  // namespace berth::sim
