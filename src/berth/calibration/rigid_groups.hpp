// Inside calibration/ only.
#pragma once

#include <cstddef>
#include <vector>

#include "berth/robot/robot_model.hpp"

namespace berth {

/// Links that no joint moves against each other. Whatever is fixed to one of them is to all.
struct RigidGroup {
  /// The one of them that a thing is said to be fixed to: of the evaluated ones, or else of all,
  /// the last in RobotModel::links.
  std::size_t link = 0;
  /// How many joints move it.
  int joints = 0;
  /// In the frame L of `link`: what surrounds their meshes by kReach_m on all sides.
  Eigen::AlignedBox3d reach_L_m;
};

/// What a link carries is looked for so far around it.
inline constexpr double kReach_m = 0.6;

/// The groups that some joint moves and that have a mesh, those before others that they move with.
/// Environment is none.
std::vector<RigidGroup> moved_groups(const RobotModel& model);

}  // namespace berth
