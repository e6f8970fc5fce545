// The closest points of a link and of what the model itself explains.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "berth/types/space_pair.hpp"

namespace berth {

/// The closest points of a link and of the environment, the robot's own other links and other
/// robots, in the robot's root frame B. While no pair is known, distance_m and the points are NaN;
/// the lower bound stands by itself.
struct KnownPair {
  /// At most lower_bound_m plus the tolerance; 0 where the two are inside one another.
  float distance_m = std::numeric_limits<float>::quiet_NaN();
  /// Nothing known is nearer to the link than this, certified; the range where nothing is within
  /// it. NaN for a link about which nothing is asked.
  float lower_bound_m = std::numeric_limits<float>::quiet_NaN();
  Eigen::Vector3f robot_point_B_m = unset_point();
  Eigen::Vector3f obstacle_point_B_m = unset_point();
  /// The other link, by its place in RobotModel::links; -1 where no pair is known.
  int link = -1;

  bool is_known() const { return link >= 0; }
};

}  // namespace berth
