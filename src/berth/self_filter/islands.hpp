#pragma once

#include <vector>

#include "berth/self_filter/robot_neighbourhood.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

struct IslandWorkspace {
  /// Pixels of the piece that is being walked.
  std::vector<Pixel> piece;
  RobotNeighbourhood neighbourhood;
  Image<std::uint8_t> state;
};

/// Marks as `island` the pieces of pixels marked `obstacle` that are leftovers of the robot's own
/// image: joined by depth (8 neighbours, steps up to island_jump_m), each pixel within
/// island_radius_m of the robot's visible surface (Euclidean, in space), and not more than a tenth
/// of them in front of the robot. A piece that leaves this neighbourhood anywhere, as an arm that
/// reaches in does, is kept whole.
void mark_islands(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                  const SelfFilterSettings& settings, IslandWorkspace& workspace,
                  Image<PixelFate>& fate);

}  // namespace berth
