// Inside berth only: a robot whose links are balls, for many configurations, and what they may not
// touch whatever cameras see.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "berth/distance/known_model.hpp"
#include "berth/distance/link_balls.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/space/clearance_field.hpp"

namespace berth::mesh {

/// Where a joint that moves puts what hangs on it: R = of_none + of_cos cos q + of_sin sin q,
/// t = at + slide q, in the frame of the joint before it, or in B.
struct BallFrame {
  /// In BallRobot::frames, before this one; -1: it hangs on the root.
  int parent = -1;
  int joint = 0;  ///< of RobotModel::joints
  float multiplier = 1, offset = 0;
  bool is_slide = false;
  Eigen::Matrix3f of_none, of_cos, of_sin;
  Eigen::Vector3f at_m, slide;
  Eigen::Vector3f axis;  ///< in the parent's frame
};

/// A moved link with shapes, its balls in its BallFrame.
struct BallLink {
  LinkId id = kNoLink;
  int frame = 0;
  LinkBalls balls;
};

/// Constant once built.
struct BallRobot {
  std::vector<BallFrame> frames;
  /// Those that are most likely near come first: the last of the tree.
  std::vector<BallLink> links;
  int joint_count = 0;

  /// Whether one joint alone moves it.
  bool is_first(const BallLink& link) const {
    return frames[static_cast<std::size_t>(link.frame)].parent < 0;
  }
};

/// A tenth of a second for each moved link.
BallRobot build_ball_robot(const RobotModel& model);

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
