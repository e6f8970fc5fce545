#include "berth/scene/calibrated_robot.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "berth/reports/calibration_coverage.hpp"
#include "tests/support/small_calibration_data.hpp"

namespace berth {
namespace {

/// The largest |reading - model| on the robot; NaN where no robot is drawn.
double worst_residual_m(const testing::SmallCalibrationData& small, std::size_t frame,
                        CalibrationSide side) {
  CalibratedRobot calibrated(small.calibration_data, small.result, 0);
  const RobotImage* robot = calibrated.draw(frame, side);
  double worst = std::nan("");
  if (!robot) return worst;
  const DepthImage residual_m = calibrated.residual_m(frame, side, *robot);
  for (const float off_m : residual_m.pixels()) {
    if (!std::isnan(off_m)) worst = std::fmax(worst, std::abs(off_m));
  }
  return worst;
}

TEST(CalibratedRobot, IsDrawnWhereTheSceneHadItAndWhereItWasFound) {
  const testing::SmallCalibrationData small;
  for (std::size_t frame : {0, 3}) {
    EXPECT_GT(worst_residual_m(small, frame, CalibrationSide::before), 0.019);
    EXPECT_LT(worst_residual_m(small, frame, CalibrationSide::after), 1e-6);
  }
}

TEST(CalibratedRobot, DepthsErrorIsTakenOutAfterTheFitAlone) {
  testing::SmallCalibrationData small;
  for (float& z_m : small.camera.frames[0].depth_m.pixels()) z_m = (z_m - 0.01F) / 1.02F;
  small.found().depth = {0.01, 1.02};
  EXPECT_LT(worst_residual_m(small, 0, CalibrationSide::after), 1e-6);
  small.camera.X_PC = small.found().X_PC;
  EXPECT_GT(worst_residual_m(small, 0, CalibrationSide::before), 0.03);
}

TEST(CalibratedRobot, JointsAreThoseOfTheClockAndTheZerosThatWereFound) {
  // Frame 3 is believed to be at 0.9 rad; its image was taken there. Its stamp is 0.3 s, the joints
  // pass 0.9 rad at 0.9 s.
  testing::SmallCalibrationData small;
  small.found().clock_offset_s = 0.6;
  EXPECT_LT(worst_residual_m(small, 3, CalibrationSide::after), 1e-6);
  small.result.joint_offsets = {{"joint_1", 0.2}};
  EXPECT_GT(worst_residual_m(small, 3, CalibrationSide::after), 0.5);
  small.found().clock_offset_s = 0.4;
  EXPECT_LT(worst_residual_m(small, 3, CalibrationSide::after), 1e-6);
}

TEST(CalibratedRobot, IsNotDrawnWhereTheJointsAreNotKnown) {
  testing::SmallCalibrationData small;
  small.found().clock_offset_s = 10;
  CalibratedRobot calibrated(small.calibration_data, small.result, 0);
  EXPECT_EQ(calibrated.draw(0, CalibrationSide::after), nullptr);
  EXPECT_NE(calibrated.draw(0, CalibrationSide::before), nullptr);
  EXPECT_TRUE(coverage_of(small.report(), 0).frames.empty());
}

TEST(CalibrationCoverage, CountsPixelsReadingsAndLinks) {
  testing::SmallCalibrationData small(4);
  DepthImage& without_arm = small.camera.frames[1].depth_m;
  without_arm = DepthImage(160, 120, 2.5F);
  small.camera.frames[2].depth_m = DepthImage(160, 120, kNoDepth);
  const CalibrationCoverage coverage = coverage_of(small.report(), 0);
  ASSERT_EQ(coverage.frames.size(), 4);
  for (const FrameCoverage& frame : coverage.frames) EXPECT_GT(frame.robot_px, 300);
  EXPECT_EQ(coverage.frames[0].fitting_px, coverage.frames[0].robot_px);
  EXPECT_LT(coverage.frames[0].median_residual_m, 1e-6);
  EXPECT_EQ(coverage.frames[1].reading_px, coverage.frames[1].robot_px);
  EXPECT_EQ(coverage.frames[1].fitting_px, 0);
  EXPECT_TRUE(std::isnan(coverage.frames[1].median_residual_m));
  EXPECT_EQ(coverage.frames[2].reading_px, 0);
  // The hand's 14 x 6 px are less than 100.
  EXPECT_EQ(coverage.frames_with_link, (std::vector<int>{2, 0}));
  EXPECT_NEAR(coverage.median_depth_m, 1.45, 0.01);
  EXPECT_NEAR(coverage.joint_range[0], 0.9, 1e-12);
  EXPECT_EQ(coverage.joint_range[1], 0);
}

TEST(CalibrationCoverage, TellsWhereInTheImageTheRobotIs) {
  const testing::SmallCalibrationData small(1);
  const CalibrationCoverage coverage = coverage_of(small.report(), 0);
  // The arm starts 0.1 m left of the middle and reaches 0.5 m to the right.
  EXPECT_NEAR(coverage.across.low, (79.5 - 140 * 0.1 / 1.45) / 160, 0.02);
  EXPECT_NEAR(coverage.across.high, (79.5 + 140 * 0.43 / 1.45) / 160, 0.05);
  EXPECT_LT(coverage.down.high - coverage.down.low, 0.25);
}

}  // namespace
}  // namespace berth
