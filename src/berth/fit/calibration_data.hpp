// What a calibration starts from: cameras, their images, and where the joints were.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "berth/robot/joint_trajectory.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

class LinkMeshes;

/// One depth image; NaN where there is no reading.
struct CalibrationFrame {
  /// Its number among the camera's images, for people.
  int number = 0;
  DepthImage depth_m;
  /// The joints at its exposure as they are believed to be.
  JointState joints;
};

/// A camera as it is believed to be, and its frames.
struct CalibrationCamera {
  std::string name;
  Camera camera;
  /// Index of the link that it is fixed to.
  std::size_t parent = 0;
  /// The pose of the optical frame C in the parent link's frame P.
  Pose X_PC = unset_pose();
  /// The joints' clock at an exposure is the frame's stamp plus this.
  double clock_offset_s = 0;
  /// Whether frames have stamps, so that the clock's offset can be asked for.
  bool has_stamps = false;
  std::vector<CalibrationFrame> frames;
};

/// All that is fitted at once.
struct CalibrationData {
  const RobotModel* model = nullptr;
  std::shared_ptr<const LinkMeshes> meshes;
  /// Where the joints were at any time; null where no camera has stamps.
  const JointTrajectory* joints = nullptr;
  /// None is null; not owned.
  std::vector<const CalibrationCamera*> cameras;
};

}  // namespace berth
