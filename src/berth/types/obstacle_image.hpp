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
  flying_patch,    ///< in a piece of readings that grows out of the robot's outline and stays near
                   ///< the robot: smeared there by the camera, or a thing. Unknown space from the
                   ///< reading on
  outside_region,  ///< not seen through the enlarged robot, where
                   ///< SelfFilterSettings::robot_region_scale is set
  soft,            ///< where something soft may hang that is attached to the robot
  speckle,         ///< a blob of fewer pixels than count as an obstacle, or a crumb of a flying
                   ///< patch
  background,      ///< kept, at the depth that the pixel had when the robot was elsewhere; its own
                   ///< reading shows the robot, or was dropped
  hole,            ///< kept: it has no reading, although the camera could read the empty cell
                   ///< there. F has what stood there then, if it is known and no environment
};
inline constexpr int kPixelFateCount = static_cast<int>(PixelFate::hole) + 1;
/// The self filter gives those up to `outside_region`, and `speckle`.
inline constexpr int kSelfFilterFateCount = 7;

/// By enumerator.
inline constexpr std::array kPixelFateNames = std::to_array<std::string_view>(
    {"obstacle", "no_reading", "robot", "environment", "padding", "flying_patch", "outside_region",
     "soft", "speckle", "background", "hole"});
static_assert(kPixelFateNames.size() == kPixelFateCount);

constexpr std::string_view name_of(PixelFate fate) {
  return kPixelFateNames[static_cast<std::size_t>(fate)];
}

/// Whether F has a depth there; a `hole` may have none.
inline bool is_kept(PixelFate fate) {
  return fate == PixelFate::obstacle || fate == PixelFate::background || fate == PixelFate::hole;
}

/// How far readings of a surface may stand off its model in space, at 1 m; NaN where nobody asks.
struct SurfaceTolerance {
  float links_m = kNoDepth;
  float environment_m = kNoDepth;
};

/// The filtered depth image F (Hirt 2.2.1): the sensor's depth without the robot, NaN at every
/// pixel that was not kept; and what became of each pixel.
struct ObstacleImage {
  DepthImage depth_m;
  Image<PixelFate> fate;
  /// Pixels of each PixelFate; they add up to the image's size.
  std::array<std::int64_t, kPixelFateCount> count{};
  /// A thinner thing that lies on the surface is in no image: an assumption.
  SurfaceTolerance surface_tolerance;

  std::int64_t count_of(PixelFate f) const { return count[static_cast<std::size_t>(f)]; }
};

}  // namespace berth
