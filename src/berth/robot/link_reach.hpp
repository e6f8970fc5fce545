// Inside berth only: how far joints move the points of a link at most.
#pragma once

#include <span>
#include <vector>

#include "berth/robot/kinematics.hpp"

namespace berth {

/// A joint that moves a link, or a link before it.
struct ChainJoint {
  /// The joint is that of RobotModel::links[link].
  std::size_t link = 0;
  /// A radian, or a metre, of it moves no point of the link farther.
  double reach_m = 0;
};

/// From RobotModel::links[link] itself to the root, fixed joints among them.
std::vector<ChainJoint> joint_chain(const RobotModel& model, std::size_t link);

/// Sets the reach of each joint of a chain: 1 where it slides, else the farthest that a point
/// within radius_m of the link's origin is from the joint's, however the joints between are turned.
/// They slide by at most slides_m from where they are, by RobotModel::joints; empty: not at all.
void find_reach(const RobotModel& model, const RobotPose& pose, double radius_m,
                std::span<const double> slides_m, std::span<ChainJoint> chain);

}  // namespace berth
