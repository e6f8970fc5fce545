#pragma once

#include "berth/distance/mesh/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// What one depth image says of the space before its camera: surfaces, what they hide, and what is
/// free. Made once a frame, at the camera's clock; then constant.
struct ViewSpace {
  Camera camera;
  SpaceSettings settings;
  /// F: the depth of what may be an obstacle; NaN elsewhere. A copy, so that a frame may be moved.
  DepthImage obstacle_depth_m;
  /// E: a point that projects into this pixel is seen free while it is nearer to the camera than
  /// this; 0 where the pixel frees nothing (whole-robot definition 2).
  DepthImage free_depth_m;
  // ... (trees over both)
};

/// Writes `out`, whose memory it reuses. `sensor_depth_m` is the raw image S, `obstacles` what the
/// self filter made of it; both have the camera's size.
void build_view_space(const Camera& camera, DepthView sensor_depth_m,
                      const ObstacleImage& obstacles, const SpaceSettings& settings,
                      ViewSpace& out);

}  // namespace berth
