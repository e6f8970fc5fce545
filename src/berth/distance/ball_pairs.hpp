// Inside berth only: what the links of a robot of balls may not touch, whatever cameras see.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "berth/distance/ball_robot.hpp"
#include "berth/distance/known_model.hpp"
#include "berth/space/clearance_field.hpp"

namespace berth::mesh {

/// The pairs of KnownModel. Constant once built.
struct BallPairs {
  /// Places in BallRobot::links: both move.
  std::vector<std::array<std::size_t, 2>> moved;
  /// What stands still, with those links that are held against it.
  struct Still {
    ClearanceField field;
    std::vector<bool> asks;
  };
  std::vector<std::unique_ptr<const Still>> still;
  /// Links with a pair that is neither: with environment that moves. Nothing is shown of them.
  std::vector<bool> others;
};

/// The places that fields tell of as for ClearanceField::build. Some tenths of a second.
BallPairs build_ball_pairs(const RobotModel& model, const KnownModel& known, const BallRobot& balls,
                           const Eigen::Vector3d& middle_B_m, double reach_m);

}  // namespace berth::mesh
