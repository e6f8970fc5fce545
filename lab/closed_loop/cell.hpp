// The bundled arm in its cell, and the cameras around it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/separation/settings.hpp"

namespace berth::lab {

struct CellCamera {
  std::string name;
  Camera camera;
  Pose X_BC;
};

/// Arm, table and floor; the latter two are environment. People are all that is not in the URDF.
const RobotModel& cell_model();

/// Those of the bundled scene.
std::vector<CellCamera> cell_cameras();

/// How fast the arm's fastest point loses speed when it brakes, and gains it.
inline constexpr double kArmDeceleration_m_s2 = 4;
inline constexpr double kArmAcceleration_m_s2 = 3;

/// What `berth calibrate` leaves unexplained of the worst of these cameras: the p99 of its
/// residuals (a test).
inline constexpr double kCellReadingError_m = 0.022;

/// d: almost all balls of this diameter in the cell are told (a test). C follows from it.
inline constexpr double kCellDetection_m = 0.020;

/// From an answer until the arm obeys; kLateController times as long at worst.
inline constexpr double kController_s = 0.010, kLateController = 2;

/// berth's defaults, but for what calibration measured, d, and the robot's data: brake, motors, and
/// the time of the loop from a request until the arm obeys the next one.
SeparationSettings cell_separation(double request_hz, double detection_m = kCellDetection_m);

/// What a fixed zone around the base has to be, as a safety scanner watches it (ISO 13855): as far
/// as the arm reaches, and the protective distance at this speed of its fastest point, with a
/// scanner's own response time and C.
double conforming_zone_m(double robot_m_s);
/// Of the arm's fastest point on its way, at full speed.
inline constexpr double kArmFullSpeed_m_s = 1.45;

/// How far distances are looked for: above what the arm needs at full speed.
inline constexpr double kCellRange_m = 2;

/// With berth's default settings but for the range, and a deadline where one is given. Without, it
/// is the same one for all: so each encounter finds what others have asked of its links' fields.
std::shared_ptr<const Robot> cell_robot(std::optional<double> deadline_us = {});

/// Of these cameras, by their place in cell_cameras(). Settings are the defaults, but for d, and
/// for speckle: these cameras mix pixels at outlines. So what shows less than 40 % of a ball of d
/// 2.2 m away is dropped.
std::vector<std::shared_ptr<const MountedCamera>> mounted_cell_cameras(
    const std::shared_ptr<const Robot>& robot, const std::vector<int>& cameras, double detection_m);

}  // namespace berth::lab
