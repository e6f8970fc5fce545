// D: how far one frame alone would move the robot.
#pragma once

#include <memory>
#include <optional>
#include <stop_token>

#include "berth/fit/calibration_data.hpp"

namespace berth {

/// Measures where a single image has the robot, against where it should be. One for each camera and
/// thread.
class FrameDisplacement {
 public:
  /// `model` has to outlive it. Readings of the robot are known to lie `bias_m` behind its surface.
  FrameDisplacement(const RobotModel& model, std::shared_ptr<const LinkMeshes> meshes,
                    const Camera& camera, std::size_t parent, const Pose& X_PC, double bias_m);

  /// The mean way of the robot's visible points, in m, from where the camera's pose has them to
  /// where they fit the image best; 0 where the image agrees hardly better there. Nothing where the
  /// image shows too little of the robot, or `stop` was requested before the fit began.
  std::optional<double> measure(DepthView depth_m, const JointState& joints,
                                const std::stop_token& stop = {}) const;

 private:
  const RobotModel* model_;
  std::shared_ptr<const LinkMeshes> meshes_;
  Camera camera_;
  std::size_t parent_;
  Pose X_PC_;
  double bias_m_;
};

}  // namespace berth
