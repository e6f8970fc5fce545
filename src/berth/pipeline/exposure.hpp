#pragma once

#include <cstdint>
#include <memory>

#include "berth/robot/kinematics.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/camera_status.hpp"
#include "berth/types/image.hpp"
#include "berth/types/joint_state.hpp"
#include "berth/types/time_status.hpp"

namespace berth {

class MountedCamera;

/// When and where one depth image was taken.
struct Exposure {
  /// Whose image it is; null in a frame that nobody has observed.
  std::shared_ptr<const MountedCamera> view;
  /// Another one at each exposure of this program.
  std::uint64_t number = 0;
  double stamp_s = 0;
  /// Unless its status is ok there is no robot and no reading in the frame, and no answer from it.
  FrameTime time;
  /// Where the camera has moved or is implausible, there is no answer either.
  CameraWatch watch;
  /// The camera's pose in the robot's root link, and the robot's, when the image was exposed.
  Pose X_BC = Pose::Identity();
  RobotPose pose;
};

/// The first step of each observer: writes `out`. Whether its time is ok; if not, the joints are
/// not looked at and the poses are unset. Throws std::invalid_argument unless the image has the
/// camera's size, and for wrong joints.
bool begin_exposure(const std::shared_ptr<const MountedCamera>& view, DepthView depth_m,
                    const JointState& at_exposure, FrameTime time, Exposure& out);

/// Throws std::invalid_argument unless the image has the camera's size.
void require_size(const Camera& camera, DepthView depth_m);

}  // namespace berth
