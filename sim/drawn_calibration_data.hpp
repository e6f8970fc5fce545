// A robot that goes through poses before a camera, for calibration: the truth, and what a camera
// and a calibration that are not right make of it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "berth/fit/calibration_data.hpp"
#include "sim/drawn_hand_camera.hpp"
#include "sim/random.hpp"

namespace berth::sim {

/// The errors that are drawn. Zeros: none.
struct CalibrationErrors {
  /// The sensor reports depths that are too large by this part of them.
  double depth_share = 0;
  /// The joints' clock at an exposure is the stamp plus this; nobody knows.
  double clock_offset_s = 0;
  /// Each joint that can be observed is off by this much, to either side; rad or, for prismatic
  /// joints, a tenth of it in m.
  double joint_zero = 0;
};

struct DrawnCalibrationSettings {
  int width_px = 640;
  int height_px = 480;
  int poses = 5;
  /// Whether images are taken while the robot moves, at up to about 1 rad/s.
  bool moves = false;
  /// Like a Kinect's: noise, steps, lost and mixed pixels, dark outlines.
  bool has_sensor_errors = true;
  CalibrationErrors errors = {};
  DrawnMount mount = DrawnMount::root;
};

/// The images are made of the truth; `calibration_data` believes the true camera and clock 0, and
/// joints that lack joint_shift.
struct DrawnCalibrationData {
  std::unique_ptr<CalibrationCamera> camera;
  std::unique_ptr<JointTrajectory> joints;
  CalibrationData calibration_data;
  Pose X_PC_true;
  /// What calibration should add to each joint.
  std::vector<double> joint_shift;
  /// The joints that are believed at each frame's true time.
  std::vector<std::vector<double>> joints_at_exposure;
};

/// In a room with some things in it that the robot never meets. Depends on its arguments alone.
/// Throws std::runtime_error where the robot cannot be seen.
DrawnCalibrationData draw_calibration_data(const RobotModel& model,
                                           std::shared_ptr<const LinkMeshes> meshes,
                                           const DrawnCalibrationSettings& settings,
                                           std::uint32_t seed);

}  // namespace berth::sim
