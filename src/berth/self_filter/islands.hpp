#pragma once

#include <vector>

#include "berth/self_filter/robot_neighbourhood.hpp"
#include "berth/self_filter/seam.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

struct IslandWorkspace {
  RobotNeighbourhood neighbourhood;
  /// What is known of each pixel; 0 everywhere between two images.
  Image<std::uint8_t> state;
  /// Pixels of the piece that is being walked.
  std::vector<Pixel> piece;
  SeamWorkspace seam;
};

/// Drops as `island` the pieces of pixels marked `obstacle` that are leftovers of the robot's own
/// image: joined by depth (8 neighbours, steps up to jump_m), each pixel in the robot's
/// neighbourhood, not more than a tenth of them in front of the robot, and hanging on the robot's
/// own readings (Seam). A camera that smooths draws its webs out from the arm, without a step. What
/// stands behind the arm and shows but a rim is small and near, too, but a step away: it is kept.
/// So is a piece that leaves the neighbourhood anywhere, as an arm that reaches in does.
/// `workspace` holds the neighbourhood with all its near pixels found, and these in its state.
///
/// What cannot be told from a web is a small thing that touches the robot's outline at its depth,
/// within jump_m; it is dropped.
void drop_islands(DepthView sensor_depth_m, const RobotImage& robot, const Tolerance& tolerance,
                  float jump_m, IslandWorkspace& workspace, ObstacleImage& out);

}  // namespace berth
