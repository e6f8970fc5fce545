#pragma once

#include <cstdint>
#include <limits>

#include "berth/types/robot_image.hpp"

namespace berth::sim {

/// What a ray from the camera meets first: its link, the depth along z, and from those who know it
/// (EmbreeRenderer) the index in the link's mesh_L.triangles.
struct RayHit {
  LinkId id = kNoLink;
  double depth_m = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = 0;
};

}  // namespace berth::sim
