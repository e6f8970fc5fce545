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
  hidden_by_robot,  ///< a link, the point's own included, or scenery of the URDF stands before it
  no_reading,       ///< its pixel has no reading, or the self filter dropped one that was there
  outside_image,    ///< it projects beside the image, or lies behind the camera
};
inline constexpr int kSightCount = 5;

/// The shares of a surface or of a space by Sight. They add up to 1; all are NaN where there is
/// nothing that could be shared.
struct SightShares {
  float seen = std::numeric_limits<float>::quiet_NaN();
  float hidden_by_obstacles = std::numeric_limits<float>::quiet_NaN();
  float hidden_by_robot = std::numeric_limits<float>::quiet_NaN();
  float no_reading = std::numeric_limits<float>::quiet_NaN();
  float outside_image = std::numeric_limits<float>::quiet_NaN();

  bool is_known() const { return !std::isnan(seen); }
};

/// How much of one link the camera sees, and of the space where something nearer than the link's
/// distance would stand.
struct LinkVisibility {
  LinkId id = kNoLink;
  /// Of the link's surface, by area, the far side and what lies inside of other links included.
  /// Known unless the link's triangles have no area.
  SightShares surface;
  /// Of the ball in which nothing stands if the answer is true, by volume. For a link that is ok:
  /// around its robot point with its distance for a radius; for one that is none_in_range
  /// (cut_short): with the range (the lower bound) for a radius, the mean over balls around the
  /// points of its surface that the robot image shows. Not known where there is no such ball: the
  /// link is not visible, or the radius is 0.
  SightShares space;
  /// The share of that space where something may stand that the image does not tell of: space's
  /// hidden_by_robot + no_reading + outside_image. What an obstacle hides is not part of it, since
  /// it counts as obstacle already (the gray area, Hirt 2.14).
  float space_unknown = std::numeric_limits<float>::quiet_NaN();
  /// The least distance, as in LinkDistance, to what was dropped for its size and place alone
  /// (PixelFate::island, speckle), and the pixel of that, where it is within the range and nearer
  /// than the link's distance: who cannot rule out a small thing there has to take this one. NaN and
  /// (-1, -1) where there is none.
  float doubtful_distance_m = std::numeric_limits<float>::quiet_NaN();
  Pixel doubtful_pixel;
};

}  // namespace berth
