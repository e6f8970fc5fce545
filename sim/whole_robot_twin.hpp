// The slow twin of a request: space around a link is cut into ever smaller cubes, the
// nearest first, and each is held against every pixel that it projects into.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "berth/robot/kinematics.hpp"
#include "sim/nearest_on_mesh.hpp"
#include "sim/whole_robot_points.hpp"

namespace berth::sim {

struct TwinSettings {
  /// L: obstacles beyond it are not looked for.
  double range_m = 1.0;
  /// The search ends once upper and lower bound are that near to each other.
  double gap_m = 0.0005;
  /// Cubes that hold an obstacle or not, nobody knows, are given up at this edge.
  double least_edge_m = 1e-4;
  /// The number of cubes after which the search is given up.
  std::size_t most_cubes = 60000;
};

/// The true distance lies between both, which are as far apart as the search had to leave them.
struct TwinInterval {
  /// No obstacle is nearer; at most the range.
  double lower_m = 0;
  /// The length of a pair of points, one on the mesh and one of an obstacle; infinite where none
  /// was found within the range.
  double upper_m = std::numeric_limits<double>::infinity();
  Eigen::Vector3d robot_point_B =
      Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d obstacle_point_B =
      Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::size_t cubes = 0;
};

struct TwinDistance {
  TwinInterval nearest;
  TwinInterval reading;
};

/// From the surface of one link, whose mesh is not empty, at X_BL.
TwinDistance twin_distance(const TriangleMesh& mesh_L, const Pose& X_BL, const PointSpace& space,
                           const TwinSettings& settings);

/// out[i] is the link with the id i + 1.
std::vector<TwinDistance> twin_distances(const RobotModel& model, const RobotPose& pose,
                                         const PointSpace& space, const TwinSettings& settings);

}  // namespace berth::sim
