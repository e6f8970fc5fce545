// What pixels without a reading free beside pixels that show the robot.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// The memory of free_holes_beside_robot().
struct RobotHolesWorkspace {
  /// How many rows above and below each pixel the next one is that shows the robot.
  Image<std::uint8_t> above;
  Image<std::uint8_t> below;
  /// A row that shows none.
  std::vector<std::uint8_t> none;
};

/// Nobody looks farther than this for the robot, in either direction.
inline constexpr int kMostRobotHole_px = 8;

/// A point is up to so far from the middle of its pixel.
inline constexpr double kHalfDiagonal_px = 0.70710678118654752;

/// Lets a pixel that has neither a reading nor an obstacle, and frees nothing, free as much as the
/// nearest pixel of the fate `robot` (of equally near ones the one that frees most), if that is
/// within f d / 2 e - kHalfDiagonal_px pixels, e being what it frees, f the lesser focal length and
/// d the detection capability: a ball of this diameter, nearer than e and with its middle in the
/// hole, would hide that pixel, which shows that there is none. `own_m` is as of
/// find_own_free_depth(). Off where d is 0.
void free_holes_beside_robot(const Camera& camera, DepthView sensor_depth_m,
                             const ObstacleImage& obstacles, double detection_capability_m,
                             RobotHolesWorkspace& workspace, DepthImage& own_m);

}  // namespace berth
