// Small images for the tests of the sensor rules.
#pragma once

#include "berth/types/obstacle_image.hpp"
#include "sim/random.hpp"

namespace berth {

/// Every reading is an obstacle.
ObstacleImage kept_image(const DepthImage& depth_m);

/// Up to 40 x 30 pixels of a few depths, some of them without reading.
DepthImage patchy_image(sim::Random& random);

}  // namespace berth
