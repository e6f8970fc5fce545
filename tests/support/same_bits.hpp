#pragma once

#include <cstring>

#include "berth/types/robot_image.hpp"

namespace berth {

/// Whether the images are equal to the last bit, NaN included.
inline bool same_bits(const DepthImage& a, const DepthImage& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size() * sizeof(float)) == 0;
}

inline bool same_bits(const RobotImage& a, const RobotImage& b) {
  return a.link_id.pixels() == b.link_id.pixels() && same_bits(a.depth_m, b.depth_m);
}

}  // namespace berth
