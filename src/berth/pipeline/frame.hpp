#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "berth/robot/kinematics.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/joint_state.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"
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

struct FrameSpace;

/// What one depth image reports, ready for any number of requests; constant while it is asked.
struct Frame : Exposure {
  Frame();
  ~Frame();
  Frame(Frame&&) noexcept;
  Frame& operator=(Frame&&) noexcept;

  /// The robot at that time.
  RobotImage robot;
  ObstacleImage obstacles;
  /// Never null but in a frame that was moved from.
  std::unique_ptr<FrameSpace> space;
  /// Whether a smaller share than kLeastReadOfImage of the sensor's pixels has a reading: a camera
  /// that is covered, or failed.
  bool is_blind = false;
  /// Whether the camera knows where it can read, or has been told what it means where it does not:
  /// else nobody reports what gives no reading, such as black clothes.
  bool tells_unread = false;
  /// The share of the image's pixels that have no reading where the empty cell has one; where the
  /// camera does not know it, of all that have none and do not show the robot. NaN without an
  /// image.
  double unread_share = std::numeric_limits<double>::quiet_NaN();
};

/// Of an image's pixels. One whose range is short, or who stands outdoors, still reads many more.
inline constexpr double kLeastReadOfImage = 0.01;

/// Empties the images of a frame whose time is not ok, so that no older image stays under the new
/// stamp.
void clear_images(const Camera& camera, Frame& frame);

}  // namespace berth
