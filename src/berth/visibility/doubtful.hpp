#pragma once

#include <vector>

#include "berth/distance/exact/exact.hpp"
#include "berth/types/link_visibility.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// The readings that were dropped only because they are few: as `island` near the robot, as
/// `speckle` anywhere. Mostly the camera made them up, but a small real thing gives the same image.
struct DoubtfulImage {
  /// The sensor's depth at such pixels; NaN elsewhere.
  DepthImage depth_m;
  /// Holds them all; empty where there are none.
  PixelRect extent;
  /// Of depth_m; its tree is built by who asks find_doubtful_distances().
  SearchableDepth searchable;
};

/// Leaves an image of this size without doubtful pixels.
void clear_doubtful(int width, int height, DoubtfulImage& out);

/// Writes `out`, whose memory it reuses; `obstacles` is what was made of `sensor_depth_m`.
void find_doubtful(DepthView sensor_depth_m, const ObstacleImage& obstacles, DoubtfulImage& out);

/// The memory of find_doubtful_distances(), made once and used for every question; one for each
/// thread.
struct DoubtfulWorkspace {
  ExactWorkspace exact;
  LinkDistances distances;
};

/// Writes the doubtful distance of out[i], the link with the id i + 1. `distances` are the answer
/// for `robot` within range_m. Allocates nothing once the workspace has grown to the scene.
void find_doubtful_distances(const Camera& camera, const RobotImage& robot,
                             const DoubtfulImage& doubtful, const LinkDistances& distances,
                             double range_m, DoubtfulWorkspace& workspace,
                             std::vector<LinkVisibility>& out);

}  // namespace berth
