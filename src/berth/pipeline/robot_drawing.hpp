// Inside pipeline/ only: the robot's image at each exposure.
#pragma once

#include "berth/pipeline/robot.hpp"
#include "berth/pipeline/still_links.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Renders a robot into one camera, and not again while it stands still.
class RobotDrawing {
 public:
  RobotDrawing(const Robot& robot, const Camera& camera)
      : renderer_(robot.meshes(), camera), still_(robot.model(), DrawnLinks::all) {}

  /// As RobotRenderer::render(); of a robot that stands still as it was rendered last.
  void draw(const RobotPose& pose, const Pose& X_BC, RobotImage& image);

 private:
  RobotRenderer renderer_;
  StillLinks still_;
  /// What was rendered; only of a robot that stood still once, since it costs a copy.
  RobotImage rendered_;
  bool has_rendered_ = false;
};

}  // namespace berth
