#pragma once

#include "berth/distance/obstacle_tree.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"
#include "berth/types/time_status.hpp"

namespace berth {

/// What one depth image tells, ready for any number of questions; constant while it is asked.
struct Frame {
  double stamp_s = 0;
  /// Unless its status is ok there is no robot and no reading in this frame, and no answer from it.
  FrameTime time;
  /// The camera's pose in the robot's root link when the image was exposed.
  Pose X_BC = Pose::Identity();
  /// The robot at that time.
  RobotPose pose;
  RobotImage robot;
  ObstacleImage obstacles;
  ObstacleTree obstacle_tree;
};

}  // namespace berth
