#pragma once

#include "berth/sensor/nearest_pixel.hpp"
#include "berth/sensor/settings.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The depth that HolePolicy::obstacle gives a pixel: nearer than any depth camera measures, so
/// that everything behind it counts as hidden, and still more than 0 in a PNG of millimetres.
inline constexpr float kHoleDepth_m = 0.01F;

struct HoleWorkspace {
  NearestPixelWorkspace nearest;
  DepthImage nearest_m;
};

/// Gives each hole a depth by the policy, and the fate `hole`. A hole is a `no_reading` pixel that
/// neither robot nor scenery covers in the model. nearest_neighbour takes the depth of the nearest
/// pixel of F that has one (Euclidean in the image; of several equally near the least depth), never
/// one of the robot; where F is empty, holes stay. Only adds obstacles.
void fill_holes(HolePolicy policy, const RobotImage& robot, HoleWorkspace& workspace,
                ObstacleImage& out);

}  // namespace berth
