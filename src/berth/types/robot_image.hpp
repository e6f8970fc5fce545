#pragma once

#include <cstdint>

#include "berth/types/image.hpp"

namespace berth {

/// Which link a robot pixel belongs to: 1, 2, ... for the links that are evaluated.
using LinkId = std::uint16_t;
inline constexpr LinkId kNoLink = 0;
/// Environment of the URDF (environment links): filtered out of the depth image and not evaluated.
inline constexpr LinkId kEnvironmentLink = 0xFFFF;

/// The robot as the camera would see it alone (Hirt 2.2.1): R, the depth of its visible surface,
/// and I, the link that each pixel shows. Both have the camera's size; depth is NaN exactly where
/// the id is kNoLink.
struct RobotImage {
  DepthImage depth_m;
  Image<LinkId> link_id;
  /// Every pixel outside is kNoLink, so that nobody has to look there. May reach beyond the image.
  PixelRect extent = kEverywhere;
};

}  // namespace berth
