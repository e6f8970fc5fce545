#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "berth/types/closest_pair.hpp"
#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"
#include "berth/types/status.hpp"

namespace berth {

/// The closest pair of one link (Hirt 2.10 to 2.14). If status is not ok, every length but the
/// lower bound is NaN and every pixel (-1, -1): never 0, never a large number, never the answer
/// before.
struct LinkDistance {
  LinkId id = kNoLink;
  LinkStatus status = LinkStatus::not_visible;
  float distance_m = std::numeric_limits<float>::quiet_NaN();
  /// No pair is closer than this. It is distance_m itself, unless the search was allowed to end
  /// early (DistanceSettings::tolerance_m, deadline_us). It is the range where nothing is within
  /// it, and 0 by a method that certifies nothing (lattice, and brute_force in a region that may
  /// miss pairs). NaN only where the link is not visible or the answer stale.
  float lower_bound_m = std::numeric_limits<float>::quiet_NaN();
  Pixel robot_pixel;
  Pixel obstacle_pixel;
  /// In the camera's optical frame C. The minimum distance vector is obstacle_point_C_m -
  /// robot_point_C_m.
  Eigen::Vector3f robot_point_C_m = unset_point();
  Eigen::Vector3f obstacle_point_C_m = unset_point();
  /// Mean of the unit vectors from robot_pixel to the mean_count obstacle pixels in its region of
  /// surveillance (Hirt 2.2.5), in frame C; its length is at most 1. NaN where mean_count is 0.
  Eigen::Vector3f mean_direction_C = unset_point();
  std::int64_t mean_count = 0;
  /// Pixels of the link in the robot image.
  int robot_pixels = 0;

  bool has_distance() const { return !std::isnan(distance_m); }
};

/// The answer for one image: links[i] has the id i + 1.
struct LinkDistances {
  std::vector<LinkDistance> links;
  /// Pair distances that were computed (the thesis plots it).
  std::int64_t pairs = 0;
};

}  // namespace berth
