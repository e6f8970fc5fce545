#pragma once

#include "berth/self_filter/grown_robot.hpp"
#include "berth/self_filter/islands.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Scratch of self_filter, one for each thread that filters.
struct SelfFilterWorkspace {
  GrownRobot grown;
  IslandWorkspace islands;
};

/// Removes the robot from the sensor's image (Hirt 2.2.1). `robot` is rendered at the pose that it
/// had when the image was exposed; both images have the camera's size; `sensor_depth_m` holds NaN
/// where there is no reading. Writes F, and for each pixel its fate, to `out`, whose memory it
/// reuses.
void self_filter(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                 const SelfFilterSettings& settings, SelfFilterWorkspace& workspace,
                 ObstacleImage& out);

}  // namespace berth
