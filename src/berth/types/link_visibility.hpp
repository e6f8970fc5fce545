#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// What a camera can know of a point, by what stands first on the line of sight to it.
enum class Sight : std::uint8_t {
  seen,                 ///< nothing stands before it
  hidden_by_obstacles,  ///< an obstacle stands before it
  hidden_by_robot,  ///< a link, the point's own included, or environment of the URDF stands before
                    ///< it
  no_reading,       ///< its pixel has no reading, or the self filter dropped one that was there
  outside_image,    ///< it projects beside the image, or lies behind the camera
};
inline constexpr int kSightCount = 5;

/// The shares of a surface or of a space by Sight. They add up to 1. All are NaN where there is no
/// surface or no space.
struct SightShares {
  float seen = std::numeric_limits<float>::quiet_NaN();
  float hidden_by_obstacles = std::numeric_limits<float>::quiet_NaN();
  float hidden_by_robot = std::numeric_limits<float>::quiet_NaN();
  float no_reading = std::numeric_limits<float>::quiet_NaN();
  float outside_image = std::numeric_limits<float>::quiet_NaN();

  bool is_known() const { return !std::isnan(seen); }
};

/// How much of one link the camera sees, and how much of the space around it. Anything nearer to
/// the link than its distance would have to stand in that space.
struct LinkVisibility {
  LinkId id = kNoLink;
  /// Shares of the link's whole surface, by area: also of its far side, and of what lies inside of
  /// other links. NaN if the link's triangles have no area.
  SightShares surface;
  /// Shares of a ball, by volume. If the answer is right, nothing stands in this ball: its centre
  /// is the link's closest point, its radius the link's distance. A link that is none_in_range
  /// (cut_short) has no closest point: its shares are the mean over balls around those points of
  /// its surface that the robot image shows, with the range (the lower bound) for a radius. NaN
  /// where there is no ball: the link is not visible, or the radius is 0.
  SightShares space;
  /// The share of that ball that the camera cannot tell anything about: space's hidden_by_robot +
  /// no_reading + outside_image. What an obstacle hides is not part of it, since it counts as
  /// obstacle already (the gray area, Hirt 2.14).
  float space_unknown = std::numeric_limits<float>::quiet_NaN();
  /// The least distance, as in LinkDistance, to readings that were dropped but may be a thing
  /// (PixelFate::flying_patch, speckle, soft), and the pixel of the nearest. Set if that is within the range and nearer than the link's distance; then take it
  /// instead wherever a small thing may come near the robot. Else NaN and (-1, -1).
  float rejected_distance_m = std::numeric_limits<float>::quiet_NaN();
  Pixel rejected_pixel;
};

}  // namespace berth
