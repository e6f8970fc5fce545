#pragma once

#include <vector>

#include "berth/types/image.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// The readings that were dropped, but may be a thing: `flying_patch` near the robot, `speckle`
/// anywhere, or something soft. Mostly the camera made them up, but a small real thing gives the same image.
struct RejectedImage {
  /// The sensor's depth at such pixels; NaN elsewhere.
  DepthImage depth_m;
  /// All of them.
  std::vector<Pixel> pixels;
};

/// Leaves an image of this size without rejected pixels.
void clear_rejected(int width, int height, RejectedImage& out);

/// Writes `out`, whose memory it reuses; `obstacles` is what was made of `sensor_depth_m`.
void find_rejected(DepthView sensor_depth_m, const ObstacleImage& obstacles, RejectedImage& out);

}  // namespace berth
