#pragma once

#include <vector>

#include "berth/self_filter/neighbourhood.hpp"
#include "berth/self_filter/tolerance.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

struct FlyingPatchWorkspace {
  Neighbourhood neighbourhood;
  /// What the robot's own readings lead to: where a piece begins that hangs on it.
  std::vector<Pixel> seam;
  /// What is known of each pixel; 0 everywhere between two images.
  Image<std::uint8_t> state;
  /// The obstacles of which something is known, piece by piece.
  std::vector<Pixel> walked;
  /// Those of the piece that is being walked whose neighbours nobody has looked at.
  std::vector<Pixel> open;
};

/// Gives leftovers of the robot's own image among the obstacles the fate `flying_patch`, and takes
/// their depths. Leftovers are pieces of obstacles, joined by depth (8 neighbours, joined.hpp),
/// that lie wholly in the neighbourhood and hang on the robot's own readings (append_seam). A
/// camera that smooths draws its flying pixels out from the arm, without a step. What stands behind
/// the arm and shows but a rim is small and near, too, but a step away: it is kept. So is a piece
/// that leaves the neighbourhood anywhere, as an arm that reaches in does.
///
/// What cannot be told from flying pixels is a small thing that touches the robot's outline at its
/// depth, within jump_m; it is dropped.
///
/// Only what hangs is walked, and only until it leaves.
void drop_flying_patches(DepthView sensor_depth_m, const RobotImage& robot,
                         const Tolerance& tolerance, float jump_m, FlyingPatchWorkspace& workspace,
                         ObstacleImage& out);

}  // namespace berth
