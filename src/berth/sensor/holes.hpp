#pragma once

#include "berth/sensor/nearest_pixel.hpp"
#include "berth/sensor/settings.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Where HolePolicy::obstacle puts an obstacle of which nothing is known: nearer than any depth
/// camera measures, so that its shadow falls on all that the pixel shows, and yet more than 0 in a
/// PNG of millimetres.
inline constexpr float kHoleDepth_m = 0.01F;

struct HoleWorkspace {
  NearestPixelWorkspace nearest;
  DepthImage nearest_m;
};

/// Gives the holes a depth by the policy, and the fate `hole`: `no_reading` pixels that the model,
/// robot or scenery, does not cover. For nearest_neighbour that is the depth of the nearest pixel
/// of F that has one (Euclidean in the image; of several equally near the least depth), never the
/// robot's own reading; where F is empty holes stay. Only adds obstacles.
void fill_holes(HolePolicy policy, const RobotImage& robot, HoleWorkspace& workspace,
                ObstacleImage& out);

}  // namespace berth
