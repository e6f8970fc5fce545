#pragma once

#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/rig.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "berth/sensor/sensor_rules.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// The camera's clock: depth images to frames. One for each thread; the rig has to outlive it.
class Observer {
 public:
  explicit Observer(const Rig& rig);

  /// Renders the robot at the joint angles of the exposure, removes it from the image, and writes
  /// all of `frame`, whose memory it reuses. `depth_m` is as large as the camera's image, NaN where
  /// there is no reading. Throws std::invalid_argument for a wrong size or wrong joints and then
  /// leaves no valid frame.
  void observe(DepthView depth_m, const JointState& at_exposure, Frame& frame);

  /// Takes what the image shows where the robot is not as background of the frames to come
  /// (Background). `frame` is what observe made of `depth_m`. For images of the place as it is
  /// meant to be: somebody who stands still becomes background too, and then is an obstacle for as
  /// long as the robot hides where he stood. Throws std::invalid_argument where
  /// SensorSettings::background_frames is 0, and for a wrong size.
  void learn_background(DepthView depth_m, const Frame& frame);

 private:
  const Rig& rig_;
  RobotRenderer renderer_;
  RobotPose pose_;
  SelfFilterWorkspace workspace_;
  SensorWorkspace sensor_;
  Background background_;
};

}  // namespace berth
