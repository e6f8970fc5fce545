#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <span>

#include "berth/types/camera.hpp"

namespace berth {

/// A box that nobody can be in, such as a wall or what a fence keeps out.
struct GuardedBox {
  /// The pose of its middle in the robot's root frame B, its axes along its edges.
  Pose X_BG = Pose::Identity();
  Eigen::Vector3d half_m = Eigen::Vector3d::Zero();

  /// Whether all within `reach_m` of a point, along the axes of B, lies in it.
  bool holds(const Eigen::Vector3d& p_B_m, double reach_m = 0) const {
    const Eigen::Matrix3d R_GB = X_BG.linear().transpose();
    const Eigen::Array3d off_m = (R_GB * (p_B_m - X_BG.translation())).cwiseAbs();
    return (off_m + reach_m * R_GB.cwiseAbs().rowwise().sum().array() <= half_m.array()).all();
  }
};

/// Whether one of them holds all within `reach_m` of a point.
inline bool is_guarded(std::span<const GuardedBox> boxes, const Eigen::Vector3d& p_B_m,
                       double reach_m = 0) {
  return std::ranges::any_of(boxes,
                             [&](const GuardedBox& box) { return box.holds(p_B_m, reach_m); });
}

}  // namespace berth
