// A robot that carries what its URDF does not have, through poses, before cameras: the truth, and
// what a calibration that knows the cameras, but not the things, starts from.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "berth/calibration/calibrate.hpp"
#include "berth/fit/calibration_data.hpp"
#include "berth/robot/attachment.hpp"
#include "sim/drawn_scene.hpp"
#include "sim/sensor_model.hpp"

namespace berth::sim {

struct CarryingRobotSettings {
  /// What the URDF does not have.
  std::vector<Attachment> carried = {};
  /// One for each pose.
  std::vector<std::vector<double>> positions = {};
  Camera camera = {};
  /// One for each camera.
  std::vector<Pose> X_BC = {};
  /// What stands in the room.
  std::vector<DrawnObstacle> room = {};
  /// What stands there in one pose, for each of them; empty: nothing.
  std::vector<std::vector<DrawnObstacle>> in_pose = {};
  SensorErrors errors = kKinectErrors;
};

/// All images of all cameras, each of which has one for each pose.
struct CarryingRobot {
  std::vector<std::unique_ptr<CalibrationCamera>> cameras;
  /// Of the robot as its URDF has it, with the true cameras.
  CalibrationData calibration_data;
  /// As calibration would find it, were it perfect.
  CalibrationResult found;
};

/// `model` is the URDF's, which has to outlive the result. Depends on its arguments alone.
CarryingRobot draw_carrying_robot(const RobotModel& model, std::shared_ptr<const LinkMeshes> meshes,
                                  const CarryingRobotSettings& settings, std::uint32_t seed);

}  // namespace berth::sim
