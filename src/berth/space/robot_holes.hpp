// What pixels without a reading free beside pixels that show the robot.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/depth_units.hpp"
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
inline constexpr int kMostRobotHole_px = 4;

/// Lets a pixel that has neither a reading nor an obstacle, or is a hole, and frees nothing, free
/// what pixels of the fate `robot` show to be free: in each quarter of it, the greatest min(e, f d
/// / 2 D), with e what such a pixel frees, D how far its middle is at most from a point of the
/// quarter, f the lesser focal length and d the detection capability; of the four quarters, the
/// least. A ball of this diameter, nearer than that and with its middle in the quarter, would hide
/// the robot's pixel, which shows that there is none. In each column the nearest such pixels above
/// and below count, at most kMostRobotHole_px rows and columns away. `own` is as of
/// find_own_free_depth(), and what is freed is rounded down. Off where d is 0.
void free_holes_beside_robot(const Camera& camera, DepthView sensor_depth_m,
                             const ObstacleImage& obstacles, double detection_capability_m,
                             RobotHolesWorkspace& workspace, UnitImage& own);

}  // namespace berth
