// The closest points of a link and of what cameras left, or of what the model itself explains.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// A point or direction that is not known.
inline Eigen::Vector3f unset_point() {
  return Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
}

/// What the obstacle's point of a pair is.
enum class ObstacleKind : std::uint8_t {
  occupied,    ///< on a surface that a camera measured
  unknown,     ///< behind such a surface, or where nothing was read, and seen free by no camera
  unobserved,  ///< in no camera's image (SpaceSettings::unobserved)
};
/// By enumerator.
inline constexpr std::array<std::string_view, 3> kObstacleKindNames = {"occupied", "unknown",
                                                                       "unobserved"};

constexpr std::string_view name_of(ObstacleKind kind) {
  return kObstacleKindNames[static_cast<std::size_t>(kind)];
}

/// The closest points of a link and the obstacles, in the robot's root frame B. While no pair is
/// known, distance_m and the points are NaN and camera is -1; the lower bound stands by itself.
struct SpacePair {
  /// The length from robot_point_B_m to obstacle_point_B_m: no more than lower_bound_m plus the
  /// tolerance, unless a deadline cut the search.
  float distance_m = std::numeric_limits<float>::quiet_NaN();
  /// No point of the obstacles is nearer to the link than this; the range where none is within it.
  float lower_bound_m = 0;
  Eigen::Vector3f robot_point_B_m = unset_point();
  Eigen::Vector3f obstacle_point_B_m = unset_point();
  ObstacleKind obstacle_is = ObstacleKind::occupied;
  /// The camera, by its place among those of the request, and the pixel of it that the obstacle's
  /// point lies in: the one that measured it, or the one that it is hidden behind. What is
  /// unobserved has no pixel, (-1, -1), and stands with the first camera.
  int camera = -1;
  Pixel obstacle_pixel;

  bool is_known() const { return camera >= 0; }
};

/// A pair as results tell it.
struct ToldPair : SpacePair {
  using SpacePair::operator=;
  /// d(distance)/dq, one number for each joint of the model, in m/rad or m/m; NaN where no pair is
  /// known. Empty unless EvaluationSettings::gradient asks for it.
  std::vector<float> gradient;
};

/// The two answers for one link. `occupied.distance_m` is never below `nearest.distance_m` where
/// both are known.
struct WholeLinkDistance {
  LinkId id = kNoLink;
  /// To what is occupied or unknown.
  SpacePair nearest;
  /// To what is occupied alone.
  SpacePair occupied;
};

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
  /// As ToldPair::gradient; the other link may move, too.
  std::vector<float> gradient;

  bool is_known() const { return link >= 0; }
};

}  // namespace berth
