// Inside pipeline/ only: the robot's image at each exposure.
#pragma once

#include <vector>

#include "berth/pipeline/robot.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Renders a robot into one camera, and not again while it stands still.
class RobotDrawing {
 public:
  /// A robot of which no point has moved by more than this in the camera's frame stands still: a
  /// reading is not known to a hundred times as much.
  static constexpr double kStill_m = 1e-5;

  RobotDrawing(const Robot& robot, const Camera& camera);

  /// As RobotRenderer::render(); of a robot that stands still as it was rendered last.
  void draw(const RobotPose& pose, const Pose& X_BC, RobotImage& image);

 private:
  void find_places(const RobotPose& pose, const Pose& X_BC);
  bool stands_still() const;

  RobotRenderer renderer_;
  /// Of each link's mesh, from its frame's origin; below 0 without one.
  std::vector<double> reach_m_;
  /// The links' poses in the camera, now and when the robot was rendered last.
  std::vector<Pose> X_CL_;
  std::vector<Pose> rendered_X_CL_;
  /// What was rendered; only of a robot that stood still once, since it costs a copy.
  RobotImage rendered_;
  bool has_rendered_ = false;
};

}  // namespace berth
