// The distance of a whole link to everything that several cameras left.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "berth/types/image.hpp"
#include "berth/types/link_distance.hpp"

namespace berth {

/// What the obstacle's point of a pair is.
enum class ObstacleKind : std::uint8_t {
  reading,  ///< on a surface that a camera measured
  hidden,   ///< behind such a surface, and no camera sees it free
};

/// The closest points of a link and the obstacles, in the robot's root frame B. While no pair is
/// known, distance_m and the points are NaN and view is -1; the lower bound stands by itself.
struct SpacePair {
  /// The length from robot_point_B_m to obstacle_point_B_m: no more than lower_bound_m plus the
  /// tolerance, unless a deadline cut the search.
  float distance_m = std::numeric_limits<float>::quiet_NaN();
  /// No point of the obstacles is nearer to the link than this; the range where none is within it.
  float lower_bound_m = 0;
  Eigen::Vector3f robot_point_B_m =
      Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  Eigen::Vector3f obstacle_point_B_m =
      Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  ObstacleKind kind = ObstacleKind::reading;
  /// The view, by its place among the views of the question, and the pixel of it that the
  /// obstacle's point lies in: the one that measured it, or the one that it is hidden behind.
  int view = -1;
  Pixel obstacle_pixel;

  bool is_known() const { return view >= 0; }
};

/// The two answers for one link. `reading.distance_m` is never below `nearest.distance_m` where both
/// are known.
struct WholeLinkDistance {
  LinkId id = kNoLink;
  /// To what is seen or hidden.
  SpacePair nearest;
  /// To what is seen alone.
  SpacePair reading;
};

}  // namespace berth
