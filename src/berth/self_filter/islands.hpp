#pragma once

#include <vector>

#include "berth/self_filter/grown_robot.hpp"
#include "berth/self_filter/seam.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

struct IslandWorkspace {
  /// The robot grown by island_radius_m.
  GrownRobot neighbourhood;
  /// Not 0 where a piece was walked; 0 everywhere between two images.
  Image<std::uint8_t> walked;
  /// Pixels of the piece that is being walked.
  std::vector<Pixel> piece;
  SeamWorkspace seam;
};

/// Decides which of the pixels marked `island`, all obstacles in the grown robot, are leftovers of
/// the robot's own image, and makes the others obstacles again. Leftovers are pieces of such pixels,
/// joined by depth (8 neighbours, joined.hpp), that are not joined to any obstacle elsewhere
/// and hang on the robot's own readings (Seam). A camera that smooths draws its webs out from the
/// arm, without a step. What stands behind the arm and shows but a rim is small and near, too, but a
/// step away: it is kept. So is a piece that leaves the grown robot anywhere, as an arm that reaches
/// in does.
///
/// What cannot be told from a web is a small thing that touches the robot's outline at its depth,
/// within jump_m; it is dropped.
void keep_islands(DepthView sensor_depth_m, const RobotImage& robot, const Tolerance& tolerance,
                  float jump_m, IslandWorkspace& workspace, ObstacleImage& out);

}  // namespace berth
