#include "berth/calibration/moved_environment.hpp"

#include <gtest/gtest.h>

#include "tests/calibration/arms.hpp"

namespace berth {
namespace {

class MovedEnvironment : public ::testing::Test {
 protected:
  MovedEnvironment() {
    // Numbers that are not places: frames may have been left out.
    for (CalibrationFrame& frame : drawn_.camera->frames) frame.number = 10 + 3 * frame.number;
  }
  std::vector<EnvironmentChange> look() const {
    return moved_environment(drawn_.calibration_data, true_result(drawn_));
  }

  /// As if something stood there that reaches over this share of the image.
  void stand_in(std::size_t frame, double share) {
    DepthImage& depth_m = drawn_.camera->frames[frame].depth_m;
    for (int v = 0; v < depth_m.height(); ++v) {
      for (int u = 0; u < share * depth_m.width(); ++u) depth_m(u, v) = 0.5F;
    }
  }

  sim::DrawnCalibrationData drawn_ = coarse_arm().draw({}, 2);
};

TEST_F(MovedEnvironment, TheArmAloneIsNoChange) { EXPECT_TRUE(look().empty()); }

TEST_F(MovedEnvironment, SomethingInOneFrameIsAChangeBeforeAndAfterIt) {
  stand_in(2, 0.25);
  const std::vector<EnvironmentChange> changes = look();
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].camera, "camera");
  EXPECT_EQ(changes[0].before, 13);
  EXPECT_EQ(changes[0].after, 16);
  EXPECT_EQ(changes[1].before, 16);
  EXPECT_EQ(changes[1].after, 19);
  for (const EnvironmentChange& one : changes) {
    EXPECT_GT(one.share, 0.1);
    EXPECT_LT(one.share, 0.6);
  }
}

TEST_F(MovedEnvironment, WhatComesAndStaysIsOneChange) {
  for (const std::size_t frame : {3U, 4U}) stand_in(frame, 0.25);
  const std::vector<EnvironmentChange> changes = look();
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].before, 16);
  EXPECT_EQ(changes[0].after, 19);
}

TEST_F(MovedEnvironment, AFewPixelsAreNone) {
  stand_in(2, 0.005);
  EXPECT_TRUE(look().empty());
}

}  // namespace
}  // namespace berth
