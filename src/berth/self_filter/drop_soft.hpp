// Readings of what hangs on the robot and bends.
#pragma once

#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// Where a camera with the optical frame C sees a soft body, which has to outlive it.
struct PosedSoftBody {
  const SoftBody* body = nullptr;
  Pose X_LC = unset_pose();
};

/// All of the robot's, with it and the camera in these poses.
void pose_soft_bodies(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
                      std::vector<PosedSoftBody>& out);

/// Gives the fate `soft` to each kept reading that lies in one of the bodies: it is no obstacle, and
/// it frees nothing behind it. To be called between self filter and sensor rules.
void drop_soft(const Camera& camera, const std::vector<PosedSoftBody>& bodies, ObstacleImage& out);

}  // namespace berth
