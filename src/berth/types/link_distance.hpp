#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"
#include "berth/types/space_pair.hpp"

namespace berth {

enum class LinkStatus : std::uint8_t {
  ok,             ///< there is a distance
  none_in_range,  ///< the link is seen, and nothing is within the range
  not_visible,    ///< the camera sees no pixel of the link: nothing is known
  cut_short,      ///< the search was stopped before it found a pair within the range
  untimely,       ///< stamps or ages allow no answer (Answer::time): nothing is known
  not_seen,       ///< method mesh: hardly anything of the link is seen by any camera. What is known
                  ///< to be near stands beside it, but nothing is promised
};
/// By enumerator.
inline constexpr std::array<std::string_view, 6> kLinkStatusNames = {
    "ok", "none_in_range", "not_visible", "cut_short", "untimely", "not_seen"};

constexpr std::string_view name_of(LinkStatus status) {
  return kLinkStatusNames[static_cast<std::size_t>(status)];
}

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
  /// miss pairs). NaN only where the link is not visible or the answer untimely.
  float lower_bound_m = std::numeric_limits<float>::quiet_NaN();
  Pixel robot_pixel;
  Pixel obstacle_pixel;
  /// In the camera's optical frame C. The minimum distance vector is obstacle_point_C_m - robot_point_C_m.
  Eigen::Vector3f robot_point_C_m = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  Eigen::Vector3f obstacle_point_C_m = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  /// Mean of the unit vectors from robot_pixel to the mean_count obstacle pixels in its region of
  /// surveillance (Hirt 2.2.5), in frame C; its length is at most 1. NaN where mean_count is 0.
  Eigen::Vector3f mean_direction_C = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  std::int64_t mean_count = 0;
  /// Pixels of the link in the robot image.
  int robot_pixels = 0;

  // The rest is of method mesh alone, and stands as it is here with the others.

  /// The camera whose obstacle_pixel it is, and whose optical frame C is meant above: its place
  /// among the frames of the question.
  int view = -1;
  ObstacleKind obstacle_kind = ObstacleKind::reading;
  /// In the robot's root frame B.
  Eigen::Vector3f robot_point_B_m = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  Eigen::Vector3f obstacle_point_B_m = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  Eigen::Vector3f mean_direction_B = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  /// To what is seen alone: distance_m counts what obstacles hide as well.
  SpacePair reading;

  bool has_distance() const { return !std::isnan(distance_m); }
};

/// The answer for one image: links[i] has the id i + 1.
struct LinkDistances {
  std::vector<LinkDistance> links;
  /// Pair distances that were computed (the thesis plots it).
  std::int64_t pairs = 0;
};

}  // namespace berth
