// How far what teach-in finds of drawn frames is from the truth.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "berth/calibration/calibrate.hpp"
#include "lab/calibration/robot_points.hpp"
#include "tests/calibration/arms.hpp"
#include "tests/support/sensor_model.hpp"

namespace berth {

inline constexpr double kDegree = std::numbers::pi / 180;

/// Believes a camera that is so far off.
inline void disturb(testing::DrawnTeachIn& drawn, double offset_m, double angle_rad,
                    std::uint32_t seed) {
  drawn.camera->X_PC = testing::miscalibrated(drawn.X_PC_true, offset_m, angle_rad, seed);
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
inline double robot_error_m(const testing::DrawnTeachIn& drawn, const CalibrationResult& found) {
  return lab::robot_points_apart_m(drawn, found.cameras[0].X_PC,
                                   joint_offsets(*drawn.teach_in.model, found));
}

/// 5 mm at worst.
inline constexpr double kWorst_m = 0.005;

inline void expect_found(const testing::DrawnTeachIn& drawn, const CalibrationResult& found) {
  EXPECT_EQ(found.cameras[0].refused, "");
  EXPECT_TRUE(found.cameras[0].is_found);
  EXPECT_LT(robot_error_m(drawn, found), kWorst_m);
}

}  // namespace berth
