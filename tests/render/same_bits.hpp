#pragma once

#include <cstring>

#include "berth/types/robot_image.hpp"

namespace berth {

/// Bits, since NaN is not equal to itself.
inline bool same_bits(const RobotImage& a, const RobotImage& b) {
  const auto& p = a.depth_m.pixels();
  const auto& q = b.depth_m.pixels();
  return a.link_id.pixels() == b.link_id.pixels() && p.size() == q.size() &&
         std::memcmp(p.data(), q.data(), p.size() * sizeof(float)) == 0;
}

}  // namespace berth
