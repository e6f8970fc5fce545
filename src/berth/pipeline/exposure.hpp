#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "berth/robot/kinematics.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/joint_state.hpp"
#include "berth/types/status.hpp"

namespace berth {

class MountedCamera;

/// Where a camera and the robot's root stood at an exposure, for those that move otherwise than by
/// the robot's joints.
struct PlaceAtExposure {
  /// The pose of the optical frame C in the mount's parent link P; none: as the mount says.
  std::optional<Pose> X_PC = {};
  /// The pose of the robot's root B in a frame W that stands still.
  Pose X_WB = Pose::Identity();
};

/// When and where one depth image was taken.
struct Exposure {
  /// Whose image it is; null in a frame that nobody has observed.
  std::shared_ptr<const MountedCamera> mounted;
  /// Another one at each exposure of this program.
  std::uint64_t number = 0;
  double stamp_s = 0;
  /// Unless its status is ok there is no robot and no reading in the frame, and no answer from it.
  FrameTime time;
  /// Where the camera has moved or is implausible, there is no answer either.
  CameraWatch watch;
  /// When the image was exposed: the camera's pose in the mount's parent link, in the robot's root
  /// link, that root's pose in a frame that stands still, and the robot's.
  Pose X_PC = Pose::Identity();
  Pose X_BC = Pose::Identity();
  Pose X_WB = Pose::Identity();
  RobotPose pose;
  /// The joints that this is made from; without positions unless the time is ok.
  JointState joints;
};

/// The first step of each observer: writes `out`. Whether its time is ok; if not, the joints are
/// not looked at and the poses are unset. Throws std::invalid_argument unless the image has the
/// camera's size, and for wrong joints.
bool begin_exposure(const std::shared_ptr<const MountedCamera>& mounted, DepthView depth_m,
                    const JointState& at_exposure, FrameTime time, const PlaceAtExposure& place,
                    Exposure& out);

/// Throws std::invalid_argument unless the image has the camera's size.
void require_size(const Camera& camera, DepthView depth_m);

}  // namespace berth
