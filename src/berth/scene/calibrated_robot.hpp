// The robot in the images of a calibration, where the scene had it and where it was found, and with
// what it carries.
#pragma once

#include <optional>

#include "berth/calibration/attached_parts.hpp"
#include "berth/calibration/calibrate.hpp"
#include "berth/fit/calibration_data.hpp"
#include "berth/fit/robot_pixels.hpp"
#include "berth/render/robot_renderer.hpp"

namespace berth {

enum class CalibrationSide { before, after };

/// Draws the robot into one camera's frames. One for each thread.
class CalibratedRobot {
 public:
  /// `calibration_data` and `result` have to outlive it.
  CalibratedRobot(const CalibrationData& calibration_data, const CalibrationResult& result,
                  std::size_t camera);

  /// Where the joints were, by what was believed or found; none where the clock that was found lies
  /// outside of what is known of them.
  std::optional<JointState> joints(std::size_t frame, CalibrationSide side) const;

  /// Valid until the next call. Null where the joints are not known at the clock that was found.
  const RobotImage* draw(std::size_t frame, CalibrationSide side);

  /// Reading - model along the optical axis; NaN where there is no reading or no robot. Environment
  /// (environment links) is none. After the fit, with the depth's error taken out.
  DepthImage residual_m(std::size_t frame, CalibrationSide side, const RobotImage& robot) const;

  const CalibrationCamera& source() const { return *data_.cameras[camera_]; }
  const CameraCalibration& found() const { return result_.cameras[camera_]; }

 private:
  const CalibrationData& data_;
  const CalibrationResult& result_;
  std::size_t camera_;
  RobotRenderer renderer_;
  RobotPose pose_;
  RobotImage image_;
};

/// Which of the parts that were found a robot carries.
enum class CarriedParts { taken, all };

/// What a calibration started from, with a robot that carries more.
class CarryingRobotData {
 public:
  /// The cameras of `bare` have to outlive it.
  CarryingRobotData(const CalibrationData& bare, const AttachedParts& parts,
                    CarriedParts which = CarriedParts::taken);
  CarryingRobotData(const CarryingRobotData&) = delete;
  CarryingRobotData& operator=(const CarryingRobotData&) = delete;

  const CalibrationData& calibration_data() const { return data_; }

 private:
  RobotModel model_;
  CalibrationData data_;
};

}  // namespace berth
