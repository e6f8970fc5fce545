#include <gtest/gtest.h>

#include <algorithm>

#include "tests/calibration/found_error.hpp"

namespace berth {
namespace {

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

TEST(JointZeros, ToldOnesAreRightAndTheFirstAndTheLastAreNeverTold) {
  const std::vector<MovableJoint>& joints = coarse_arm().model.joints;
  std::size_t told = 0;
  for (const std::uint32_t seed : {1U}) {
    SCOPED_TRACE(seed);
    sim::DrawnCalibrationData drawn = coarse_arm().draw(
        {.width_px = 320, .height_px = 240, .poses = 10, .errors = {.joint_zero = 1 * kDegree}},
        seed);
    disturb(drawn, 0.03, 3 * kDegree, seed);
    const CalibrationResult found = calibrate(drawn.calibration_data, {.joint_zeros = true});
    EXPECT_EQ(found.cameras[0].refused, "");
    EXPECT_TRUE(holds(found.joints_not_determined, joints.front().name));
    EXPECT_TRUE(holds(found.joints_not_determined, joints.back().name));
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const auto offset = found.joint_offsets.find(joints[j].name);
      const bool is_told = offset != found.joint_offsets.end();
      EXPECT_NE(is_told, holds(found.joints_not_determined, joints[j].name)) << joints[j].name;
      if (!is_told) continue;
      ++told;
      EXPECT_NEAR(offset->second, drawn.joint_shift[j], 0.3 * kDegree) << joints[j].name;
    }
  }
  EXPECT_GE(told, 2U) << "of five that can be observed";
}

TEST(JointZeros, WhereTheyAreRightWhatIsToldIsNothing) {
  sim::DrawnCalibrationData drawn =
      coarse_arm().draw({.width_px = 320, .height_px = 240, .poses = 10}, 3);
  const CalibrationResult found = calibrate(drawn.calibration_data, {.joint_zeros = true});
  for (const auto& [joint, offset] : found.joint_offsets) {
    EXPECT_NEAR(offset, 0, 0.3 * kDegree) << joint;
  }
  EXPECT_LT(robot_error_m(drawn, found), kWorst_m);
}

TEST(JointZeros, TheyAreNotLookedForUnasked) {
  const sim::DrawnCalibrationData drawn =
      coarse_arm().draw({.width_px = 320, .height_px = 240, .poses = 3}, 1);
  const CalibrationResult found = calibrate(drawn.calibration_data);
  EXPECT_TRUE(found.joint_offsets.empty());
  EXPECT_TRUE(found.joints_not_determined.empty());
}

}  // namespace
}  // namespace berth
