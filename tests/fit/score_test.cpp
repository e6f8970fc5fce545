#include "berth/fit/score.hpp"

#include <gtest/gtest.h>

#include "berth/fit/fit.hpp"
#include "tests/calibration/found_error.hpp"

namespace berth {
namespace {

class ScoreOf : public ::testing::Test {
 protected:
  /// With the camera moved by this much before the truth.
  CalibrationEstimate off_by(double offset_m, double angle_rad, std::uint32_t seed = 1) const {
    CalibrationEstimate estimate = start_of(drawn_.calibration_data);
    estimate.cameras[0].X_PC = sim::miscalibrated(drawn_.X_PC_true, offset_m, angle_rad, seed);
    return estimate;
  }
  Score of(const CalibrationEstimate& estimate, const ScoreSettings& settings = {}) {
    return score(drawer_, estimate, settings);
  }

  sim::DrawnCalibrationData drawn_ = bundled_arm().draw({.poses = 3}, 2);
  FrameDrawer drawer_{drawn_.calibration_data, {1, 2}};
};

TEST_F(ScoreOf, TheTruthIsBestAndFartherIsWorse) {
  const double truth = of(off_by(0, 0)).value;
  EXPECT_GT(truth, 1.2);
  EXPECT_LE(truth, 2);
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const double near = of(off_by(0.01, 1 * kDegree, seed)).value;
    const double middle = of(off_by(0.04, 4 * kDegree, seed)).value;
    const double far = of(off_by(0.20, 20 * kDegree, seed)).value;
    EXPECT_GT(truth, near);
    EXPECT_GT(near, middle);
    EXPECT_GT(middle, far);
    EXPECT_LT(far, 0.6) << "a wrong place";
  }
}

TEST_F(ScoreOf, WithoutOutlinesItIsOneAtMost) {
  const Score depth = of(off_by(0, 0), {.outline_reach_px = 0});
  EXPECT_GT(depth.value, 0.6);
  EXPECT_LE(depth.value, 1);
  EXPECT_EQ(depth.places, 0);
  EXPECT_GT(of(off_by(0, 0)).places, 100);
}

TEST_F(ScoreOf, WhatIsSeenThroughCountsAgainstItMoreThanWhatIsHidden) {
  const ScoreSettings depth_alone{.outline_reach_px = 0};
  const CalibrationEstimate truth = off_by(0, 0);
  for (CalibrationFrame& frame : drawn_.camera->frames) {
    std::fill(frame.depth_m.pixels().begin(), frame.depth_m.pixels().end(), 9.0F);
  }
  FrameDrawer through(drawn_.calibration_data, {1});
  EXPECT_EQ(score(through, truth, depth_alone).value, -1);
  for (CalibrationFrame& frame : drawn_.camera->frames) {
    std::fill(frame.depth_m.pixels().begin(), frame.depth_m.pixels().end(), 0.2F);
  }
  FrameDrawer hidden(drawn_.calibration_data, {1});
  EXPECT_EQ(score(hidden, truth, depth_alone).value, -0.25);
}

TEST_F(ScoreOf, APoseThatShowsLittleOfTheRobotCountsAsIfItShowedMore) {
  const Score all = of(off_by(0, 0), {.outline_reach_px = 0});
  const Score little = of(off_by(0, 0), {.outline_reach_px = 0, .least_pixels = 2 * all.pixels});
  EXPECT_NEAR(little.value, all.value / 2, 1e-9);
  const Score as_before = of(off_by(0, 0), {.outline_reach_px = 0, .least_pixels = all.pixels / 2});
  EXPECT_EQ(as_before.value, all.value);
}

TEST_F(ScoreOf, WhereNoFrameShowsTheRobotItIsWorst) {
  CalibrationEstimate away = off_by(0, 0);
  away.cameras[0].X_PC.rotate(Eigen::AngleAxisd(EIGEN_PI, Eigen::Vector3d::UnitY()));
  EXPECT_EQ(of(away).value, -2);
}

TEST_F(ScoreOf, HalvesOfTheFramesMakeTheWhole) {
  const CalibrationEstimate truth = off_by(0, 0);
  const double even = score(drawer_, truth, {}, FrameChoice::even).pixels;
  const double odd = score(drawer_, truth, {}, FrameChoice::odd).pixels;
  EXPECT_GT(odd, 0);
  EXPECT_EQ(even + odd, of(truth).pixels);
}

}  // namespace
}  // namespace berth
