// For who makes frames.
#pragma once

#include <optional>

#include "berth/pipeline/robot_drawing.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/space/camera_space.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Where the solid of the environment begins and ends along the rays of one camera.
class EnvironmentBack {
 public:
  EnvironmentBack(const RobotModel& model, const Camera& camera);

  /// At each pixel that would show environment if there were no robot, the depth of the surface
  /// that is seen, and of the next one behind it, or of that one itself where there is no other;
  /// NaN elsewhere. Without environment images of no size. Until the next call.
  EnvironmentSurfaces at(const RobotPose& pose, const Pose& X_BC);

 private:
  void render(const RobotPose& pose, const Pose& X_BC);

  /// None without environment.
  std::optional<RobotRenderer> renderer_;
  StillLinks still_;
  RobotImage front_;
  RobotImage back_;
  std::uint64_t serial_number_ = 0;
};

}  // namespace berth
