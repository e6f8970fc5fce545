// A second opinion on RobotRenderer: Embree's ray caster.
#pragma once

#include <memory>

#include "berth/robot/kinematics.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/types/camera.hpp"
#include "tests/support/ray_hit.hpp"

namespace berth {

/// One robot in one pose, seen by one camera.
class EmbreeRenderer {
 public:
  /// `pose` holds all of the model's links; X_BC is the camera's pose in the root link's frame.
  /// Throws std::runtime_error where Embree fails.
  EmbreeRenderer(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
                 const Camera& camera);
  ~EmbreeRenderer();
  EmbreeRenderer(const EmbreeRenderer&) = delete;
  EmbreeRenderer& operator=(const EmbreeRenderer&) = delete;

  /// What the ray through (u, v), in pixels, meets first.
  RayHit hit(double u, double v) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace berth
