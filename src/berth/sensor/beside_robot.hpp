// Inside sensor/ only.
#pragma once

#include "berth/self_filter/self_filter.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The memory of find_beside_robot().
struct BesideRobotWorkspace {
  RobotImage links;
  SelfFilterWorkspace filter;
  ObstacleImage left;
};

/// How near to the robot in the image, at its depth, cameras leave a dark outline and a stereo
/// shadow: a pixel that has no reading there says nothing.
inline constexpr double kRobotShadow_m = 0.06;

/// Which pixels the evaluated links do not cover once they are grown by `clearance_m` in the image,
/// on all sides and at all depths: of those with a depth, all whose fate is `obstacle`. Until the
/// next call.
const Image<PixelFate>& find_beside_robot(const Camera& camera, DepthView depth_m,
                                          const RobotImage& robot, double clearance_m,
                                          BesideRobotWorkspace& workspace);

}  // namespace berth
