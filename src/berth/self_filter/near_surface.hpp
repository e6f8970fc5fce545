// Inside self_filter/ only: which pixels are near the robot's surface, tile by tile, in vectors.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/self_filter/boxes.hpp"
#include "berth/self_filter/tiles.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The robot's pixel (u, v) of depth z, like any, lies at (ray_x[u] z, ray_y[v] z, z).
struct RobotSurface {
  const RobotImage& robot;
  const float* ray_x;
  const float* ray_y;
};

struct DepthRange {
  float min_m;
  float max_m;
};

/// The obstacle pixels in a range of depths.
struct CandidatePixels {
  DepthView sensor_depth_m;
  const Image<PixelFate>& fate;
  DepthRange range;
};

/// The box around the evaluated links' pixels within `pixels`.
BoxC box_of_robot(const RobotSurface& surface, const PixelRect& pixels);

/// The box around the candidates within `pixels`.
BoxC box_of_candidates(const RobotSurface& surface, const CandidatePixels& candidates,
                       const PixelRect& pixels);

/// A tile of robot pixels.
struct RobotTile {
  PixelRect pixels;
  BoxC box;
};

/// Writes 1 to near(u, v) for every candidate within `pixels`, 0 for the other pixels there.
void mark_candidates(const CandidatePixels& candidates, const PixelRect& pixels,
                     Image<std::uint8_t>& near);

/// Writes 1 to near(u, v) for those candidates within `pixels` that some robot pixel of `tiles` is
/// within the radius of; returns whether there is one. Reorders the tiles.
bool mark_near(const RobotSurface& surface, const CandidatePixels& candidates,
               const PixelRect& pixels, float radius2_m2, std::vector<RobotTile>& tiles,
               Image<std::uint8_t>& near);

}  // namespace berth
