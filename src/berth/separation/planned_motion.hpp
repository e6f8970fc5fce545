#pragma once

#include <span>
#include <vector>

#include "berth/types/joint_state.hpp"

namespace berth {

/// How the robot goes on if nobody slows it down.
struct PlannedMotion {
  PlannedMotion() = default;
  PlannedMotion(std::span<const double> of_joints, std::span<const JointState> way = {})
      : velocity(of_joints), path(way) {}
  PlannedMotion(const std::vector<double>& of_joints) : velocity(of_joints) {}

  /// The joints' velocities (rad/s or m/s) at the joints that a result is about: as measured, or
  /// those that the program wants, if it obeys the scale.
  std::span<const double> velocity;
  /// Where the joints are after JointState::stamp_s at full speed, from 0 on; between two states
  /// they go straight. The robot stays on this way, also while it brakes. Empty: not known; then it
  /// is taken to go straight on, and to turn by what it may accelerate.
  std::span<const JointState> path;
};

}  // namespace berth
