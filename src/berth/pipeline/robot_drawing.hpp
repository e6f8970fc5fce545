// For who makes frames: the robot's image at each exposure, and the environment's.
#pragma once

#include <optional>
#include <vector>

#include "berth/pipeline/robot.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/space/camera_space.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Tells whether links stand still before a camera, so that they need not be drawn again.
class StillLinks {
 public:
  /// Links of which no point has moved by more than this in the camera's frame stand still: a
  /// reading is not known to a hundred times as much.
  static constexpr double kStill_m = 1e-5;

  StillLinks(const RobotModel& model, DrawnLinks drawn);

  /// Whether there is nothing that could be drawn.
  bool is_empty() const { return links_.empty(); }

  /// Whether they stand where they stood at the last drawn_at().
  bool stand_at(const RobotPose& pose, const Pose& X_BC) const;
  void drawn_at(const RobotPose& pose, const Pose& X_BC);

 private:
  struct Drawn {
    std::size_t link;
    /// From its frame's origin.
    double reach_m;
    /// When it was drawn.
    Pose X_CL;
  };
  std::vector<Drawn> links_;
  bool has_drawn_ = false;
};

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
