#include "berth/watch/frame_displacement.hpp"

#include <gtest/gtest.h>

#include "sim/sensor_model.hpp"
#include "tests/calibration/arms.hpp"

namespace berth {
namespace {

class FrameDisplacementOf : public ::testing::Test {
 protected:
  FrameDisplacement at(const Pose& X_PC, double bias_m = 0) const {
    return {coarse_arm().model, coarse_arm().meshes, drawn_.camera->camera, 0, X_PC, bias_m};
  }

  sim::DrawnCalibrationData drawn_ = coarse_arm().draw({.poses = 3}, 2);
};

TEST_F(FrameDisplacementOf, AtTheRightPoseItIsSmallAndTwoCentimetresOffItIsNot) {
  for (const CalibrationFrame& frame : drawn_.camera->frames) {
    SCOPED_TRACE(frame.number);
    const auto right_m = at(drawn_.X_PC_true).measure(frame.depth_m, frame.joints);
    ASSERT_TRUE(right_m);
    EXPECT_LT(*right_m, 0.003);
    for (std::uint32_t seed = 1; seed <= 2; ++seed) {
      const Pose moved = sim::miscalibrated(drawn_.X_PC_true, 0.02, 0, seed);
      const auto moved_m = at(moved).measure(frame.depth_m, frame.joints);
      ASSERT_TRUE(moved_m);
      EXPECT_GT(*moved_m, 0.010);
      EXPECT_LT(*moved_m, 0.030);
    }
  }
}

TEST_F(FrameDisplacementOf, AKnownBiasIsNoDisplacement) {
  CalibrationFrame& frame = drawn_.camera->frames[0];
  for (float& z_m : frame.depth_m.pixels()) z_m += 0.02F;
  const auto known_m = at(drawn_.X_PC_true, 0.02).measure(frame.depth_m, frame.joints);
  const auto unknown_m = at(drawn_.X_PC_true).measure(frame.depth_m, frame.joints);
  ASSERT_TRUE(known_m && unknown_m);
  EXPECT_LT(*known_m, 0.003);
  EXPECT_GT(*unknown_m, *known_m);
}

TEST_F(FrameDisplacementOf, AFrameWithoutRobotTellsNothing) {
  const CalibrationFrame& frame = drawn_.camera->frames[0];
  const Pose away = drawn_.X_PC_true * Eigen::AngleAxisd(EIGEN_PI, Eigen::Vector3d::UnitY());
  EXPECT_FALSE(at(away).measure(frame.depth_m, frame.joints));
  const DepthImage blind(640, 480, kNoDepth);
  EXPECT_FALSE(at(drawn_.X_PC_true).measure(blind, frame.joints));
}

TEST_F(FrameDisplacementOf, IsNotBegunOnceItIsToStop) {
  std::stop_source source;
  const CalibrationFrame& frame = drawn_.camera->frames[0];
  EXPECT_TRUE(at(drawn_.X_PC_true).measure(frame.depth_m, frame.joints, source.get_token()));
  source.request_stop();
  EXPECT_FALSE(at(drawn_.X_PC_true).measure(frame.depth_m, frame.joints, source.get_token()));
}

}  // namespace
}  // namespace berth
