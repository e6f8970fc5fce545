// Inside berth only: a robot whose links are balls, for many configurations.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "berth/distance/link_balls.hpp"
#include "berth/robot/robot_model.hpp"

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

  /// Whether one turning joint alone moves it.
  bool is_turned(const BallLink& link) const {
    const BallFrame& frame = frames[static_cast<std::size_t>(link.frame)];
    return frame.parent < 0 && !frame.is_slide;
  }
};

/// A tenth of a second for each moved link.
BallRobot build_ball_robot(const RobotModel& model);

}  // namespace berth::mesh
