#pragma once

#include <vector>

#include "sim/drawn_calibration_data.hpp"

namespace berth::lab {

/// How far the points of the robot, as the camera sees them, lie from where they truly are: a mean
/// over all frames and all corners of evaluated links. `joint_offsets` is what was found of each
/// joint.
double robot_points_apart_m(const sim::DrawnCalibrationData& drawn, const Pose& X_PC_found,
                            const std::vector<double>& joint_offsets);

/// The same over the points that the camera sees: for one that the robot carries, most of the rest
/// lies behind it.
double seen_points_apart_m(const sim::DrawnCalibrationData& drawn, const Pose& X_PC_found,
                           const std::vector<double>& joint_offsets);

}  // namespace berth::lab
