#pragma once

#include <vector>

#include "berth/self_filter/robot_neighbourhood.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

struct IslandWorkspace {
  RobotNeighbourhood neighbourhood;
  /// What is known of each pixel; 0 everywhere between two images.
  Image<std::uint8_t> state;
  /// Pixels of the piece that is being walked.
  std::vector<Pixel> piece;
};

/// Drops as `island` the pieces of pixels marked `obstacle` that are leftovers of the robot's own
/// image: joined by depth (8 neighbours, steps up to jump_m), each pixel in the robot's
/// neighbourhood, and not more than a tenth of them in front of the robot. A piece that leaves this
/// neighbourhood anywhere, as an arm that reaches in does, is kept whole. `workspace` holds the
/// neighbourhood with all its near pixels found, and these in its state.
void drop_islands(DepthView sensor_depth_m, const RobotImage& robot, float jump_m,
                  IslandWorkspace& workspace, ObstacleImage& out);

}  // namespace berth
