#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "berth/types/image.hpp"

namespace berth {

/// What became of one pixel of the sensor's depth image: in the self filter, then in the sensor
/// rules. The order is that of the rules.
enum class PixelFate : std::uint8_t {
  obstacle,        ///< kept: it may be an obstacle
  no_reading,      ///< the sensor gave nothing here
  robot,           ///< on the robot, or behind it
  environment,     ///< on an environment link of the URDF, or behind it
  padding,         ///< within the link's metric padding beside the robot, and not in front of it
  dilation,        ///< within the silhouette grown by a number of pixels, and not in front of it
  edge,            ///< a mixed pixel at a depth edge
  flying_patch,    ///< in a small patch of readings that grows out of the robot's outline and stays
                   ///< near the robot: the camera smeared it there
  outside_region,  ///< not seen through the enlarged robot, where
                   ///< SelfFilterSettings::robot_region_scale is set
  soft,            ///< where something soft may hang that is attached to the robot
  speckle,         ///< a blob of fewer pixels than count as an obstacle
  averaged,        ///< kept, at the mean of the pixel's last readings: it is nearer than the newest
  background,      ///< kept, at the depth that the pixel had when the robot was elsewhere; its own
                   ///< reading shows the robot, or was dropped
  hole,            ///< kept: it has no reading, and HolePolicy says that something is there
};
inline constexpr int kPixelFateCount = 14;
/// The self filter gives those up to `outside_region`.
inline constexpr int kSelfFilterFateCount = 9;

/// By enumerator.
inline constexpr std::array<std::string_view, kPixelFateCount> kPixelFateNames = {
    "obstacle",     "no_reading",     "robot", "environment", "padding",  "dilation",   "edge",
    "flying_patch", "outside_region", "soft",  "speckle",     "averaged", "background", "hole"};

constexpr std::string_view name_of(PixelFate fate) {
  return kPixelFateNames[static_cast<std::size_t>(fate)];
}

/// Whether F has a depth there.
inline bool is_kept(PixelFate fate) {
  return fate == PixelFate::obstacle || fate == PixelFate::averaged ||
         fate == PixelFate::background || fate == PixelFate::hole;
}

/// The filtered depth image F (Hirt 2.2.1): the sensor's depth without the robot, NaN at every
/// pixel that was not kept; and what became of each pixel.
struct ObstacleImage {
  DepthImage depth_m;
  Image<PixelFate> fate;
  /// Pixels of each PixelFate; they add up to the image's size.
  std::array<std::int64_t, kPixelFateCount> count{};

  std::int64_t count_of(PixelFate f) const { return count[static_cast<std::size_t>(f)]; }
};

}  // namespace berth
