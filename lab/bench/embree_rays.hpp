// What RobotRenderer is measured beside: Embree's ray caster.
#pragma once

#include <memory>

#include "berth/robot/kinematics.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth::lab {

/// One robot and one camera: each link a mesh of its own, built once and moved as an instance; one
/// ray through each pixel's centre inside the links' image rectangles, in coherent packets of 16.
/// Without Embree's robust mode, which is slower.
class EmbreeRays {
 public:
  /// Throws std::runtime_error where Embree fails.
  EmbreeRays(const RobotModel& model, const Camera& camera);
  ~EmbreeRays();
  EmbreeRays(const EmbreeRays&) = delete;
  EmbreeRays& operator=(const EmbreeRays&) = delete;

  /// As RobotRenderer::render, on the threads that TBB has.
  void render(const RobotPose& pose, const Pose& X_BC, RobotImage& image);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace berth::lab
