// The robot in the images of a teach-in, where the scene had it and where it was found.
#pragma once

#include <optional>

#include "berth/calibration/calibrate.hpp"
#include "berth/calibration/robot_pixels.hpp"
#include "berth/calibration/teach_in.hpp"
#include "berth/render/robot_renderer.hpp"

namespace berth {

enum class TeachInSide { before, after };

/// Draws the robot into one camera's frames. One for each thread.
class TaughtRobot {
 public:
  /// `teach_in` and `result` have to outlive it.
  TaughtRobot(const TeachIn& teach_in, const CalibrationResult& result, std::size_t camera);

  /// Where the joints were, by what was believed or found; none where the clock that was found lies
  /// outside of what is known of them.
  std::optional<JointState> joints(std::size_t frame, TeachInSide side) const;

  /// Valid until the next call. Null where the joints are not known at the clock that was found.
  const RobotImage* draw(std::size_t frame, TeachInSide side);

  /// Reading - model along the optical axis; NaN where there is no reading or no robot. Scenery
  /// (environment links) is none. After the fit, with the depth's error taken out.
  DepthImage residual_m(std::size_t frame, TeachInSide side, const RobotImage& robot) const;

  const TeachInCamera& source() const { return *teach_in_.cameras[camera_]; }
  const CameraCalibration& found() const { return result_.cameras[camera_]; }

 private:
  const TeachIn& teach_in_;
  const CalibrationResult& result_;
  std::size_t camera_;
  RobotRenderer renderer_;
  RobotPose pose_;
  RobotImage image_;
};

}  // namespace berth
