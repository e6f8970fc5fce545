#pragma once

#include <optional>

#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/rig.hpp"
#include "berth/self_filter/self_filter.hpp"
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

 private:
  void filter(DepthView depth_m, Frame& frame);

  const Rig& rig_;
  RobotRenderer renderer_;
  /// Of the robot-shaped region, where there is one.
  std::optional<RobotRenderer> region_renderer_;
  RobotImage region_;
  RobotPose pose_;
  SelfFilterWorkspace workspace_;
};

}  // namespace berth
