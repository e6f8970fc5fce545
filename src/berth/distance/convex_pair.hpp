// The closest points of two small convex bodies.
#pragma once

#include <Eigen/Core>
#include <span>

namespace berth::mesh {

struct ConvexPair {
  double distance_m = 0;
  /// Equal where the bodies meet.
  Eigen::Vector3d a_m;
  Eigen::Vector3d b_m;
};

/// Of the convex hulls of two sets of points, of which neither is empty (Gilbert, Johnson and
/// Keerthi 1988; subsets of the simplex are tried one by one).
ConvexPair closest_points(std::span<const Eigen::Vector3d> a_m,
                          std::span<const Eigen::Vector3d> b_m);

}  // namespace berth::mesh
