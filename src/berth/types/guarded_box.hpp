#pragma once

#include <Eigen/Core>
#include <span>

#include "berth/types/camera.hpp"

namespace berth {

/// A box that nobody can be in, such as a wall or what a fence keeps out.
struct GuardedBox {
  /// The pose of its middle in the robot's root frame B, its axes along its edges.
  Pose X_BG = Pose::Identity();
  Eigen::Vector3d half_m = Eigen::Vector3d::Zero();

  /// Whether all within `reach_m` of a point, along the axes of B, lies in it.
  bool holds(const Eigen::Vector3d& p_B_m, double reach_m = 0) const;
};

/// Whether one of them holds all within `reach_m` of a point.
bool is_in_one(std::span<const GuardedBox> boxes, const Eigen::Vector3d& p_B_m, double reach_m);

/// The same, without a call where there is no box: loops over all of space ask.
inline bool is_guarded(std::span<const GuardedBox> boxes, const Eigen::Vector3d& p_B_m,
                       double reach_m = 0) {
  return !boxes.empty() && is_in_one(boxes, p_B_m, reach_m);
}

}  // namespace berth
