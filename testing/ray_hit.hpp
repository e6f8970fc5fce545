#pragma once

#include <limits>

#include "berth/types/robot_image.hpp"

namespace berth {

/// What a ray from the camera meets first: its link, and the depth along z.
struct RayHit {
  LinkId id = kNoLink;
  double depth_m = std::numeric_limits<double>::infinity();
};

}  // namespace berth
