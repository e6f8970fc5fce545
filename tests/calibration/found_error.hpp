// How far what calibration finds of drawn frames is from the truth.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "berth/calibration/calibrate.hpp"
#include "lab/calibration/robot_points.hpp"
#include "sim/sensor_model.hpp"
#include "tests/calibration/arms.hpp"

namespace berth {

inline constexpr double kDegree = std::numbers::pi / 180;

/// Believes a camera that is so far off.
inline void disturb(sim::DrawnCalibrationData& drawn, double offset_m, double angle_rad,
                    std::uint32_t seed) {
  drawn.camera->X_PC = sim::miscalibrated(drawn.X_PC_true, offset_m, angle_rad, seed);
}

/// What was found of each joint; 0 of one that was not told.
inline std::vector<double> joint_offsets(const RobotModel& model, const CalibrationResult& found) {
  std::vector<double> offsets;
  for (const MovableJoint& joint : model.joints) {
    const auto offset = found.joint_offsets.find(joint.name);
    offsets.push_back(offset == found.joint_offsets.end() ? 0 : offset->second);
  }
  return offsets;
}

/// In the mean over the robot's points.
inline double robot_error_m(const sim::DrawnCalibrationData& drawn,
                            const CalibrationResult& found) {
  return lab::robot_points_apart_m(drawn, found.cameras[0].X_PC,
                                   joint_offsets(*drawn.calibration_data.model, found));
}

/// 5 mm at worst.
inline constexpr double kWorst_m = 0.005;

inline void expect_found(const sim::DrawnCalibrationData& drawn, const CalibrationResult& found) {
  EXPECT_EQ(found.cameras[0].refused, "");
  EXPECT_TRUE(found.cameras[0].is_found);
  EXPECT_LT(robot_error_m(drawn, found), kWorst_m);
}

}  // namespace berth
