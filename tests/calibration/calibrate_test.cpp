// The camera's pose, clock and depth error from drawn frames whose truth is known. All of it, with
// more robots and starts: build/release/lab/measure_calibration.
#include "berth/calibration/calibrate.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/calibration/found_error.hpp"
#include "tests/support/data_folder.hpp"

namespace berth {
namespace {

using sim::DrawnCalibrationData;

constexpr sim::DrawnCalibrationSettings kQuick{.width_px = 320, .height_px = 240};

TEST(Calibrate, ThePoseComesBackFromFiveCentimetresAndDegrees) {
  std::vector<double> errors_m;
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    DrawnCalibrationData drawn = bundled_arm().draw({}, seed);
    disturb(drawn, 0.05, 5 * kDegree, seed + 100);
    const CalibrationResult found = calibrate(drawn.calibration_data);
    expect_found(drawn, found);
    errors_m.push_back(robot_error_m(drawn, found));
    const CameraCalibration& camera = found.cameras[0];
    EXPECT_GT(camera.score_after, camera.score_before);
    EXPECT_LT(camera.after.median_m, camera.before.median_m);
    EXPECT_GT(camera.moved_m, 0.02);
    EXPECT_LT(camera.halves_m, 0.01);
    EXPECT_EQ(camera.frames, (std::vector{0, 1, 2, 3, 4}));
    EXPECT_EQ(camera.clock_offset_s, 0);
    EXPECT_EQ(std::count(camera.not_determined.begin(), camera.not_determined.end(), "pose"), 0);
    EXPECT_EQ(
        std::count(camera.not_determined.begin(), camera.not_determined.end(), "clock_offset_s"),
        1);
    EXPECT_TRUE(found.joint_offsets.empty());
  }
  std::sort(errors_m.begin(), errors_m.end());
  EXPECT_LT(errors_m[1], 0.0025) << "the median";
}

TEST(Calibrate, ThePoseComesBackFromTwentyCentimetresAndFifteenDegrees) {
  DrawnCalibrationData drawn = coarse_arm().draw(kQuick, 1);
  disturb(drawn, 0.20, 15 * kDegree, 201);
  expect_found(drawn, calibrate(drawn.calibration_data));
}

TEST(Calibrate, RealRobotsComeBackToo) {
  const std::filesystem::path robots = data_folder() / "robots";
  if (!std::filesystem::exists(robots)) GTEST_SKIP() << robots << " is missing";
  for (const char* urdf : {"xarm7/xarm7.urdf", "kuka_lbr_med7/lbr_med7.urdf"}) {
    SCOPED_TRACE(urdf);
    const Arm arm({.urdf = robots / urdf});
    DrawnCalibrationData drawn = arm.draw({}, 3);
    disturb(drawn, 0.05, 5 * kDegree, 300);
    expect_found(drawn, calibrate(drawn.calibration_data));
  }
}

TEST(Calibrate, AStartThatIsRightIsKept) {
  DrawnCalibrationData drawn = coarse_arm().draw(kQuick, 2);
  const CalibrationResult found = calibrate(drawn.calibration_data);
  EXPECT_LT(robot_error_m(drawn, found), 0.0025);
  EXPECT_LT(found.cameras[0].moved_m, 0.0025);
  EXPECT_GE(found.cameras[0].score_after, found.cameras[0].score_before);
}

TEST(Calibrate, AStartThatIsNotBetteredIsKeptAndSaysSo) {
  // An ideal sensor: nothing agrees better with the images than the truth.
  DrawnCalibrationData drawn = bundled_arm().draw({.has_sensor_errors = false}, 4);
  const CameraCalibration found = calibrate(drawn.calibration_data).cameras[0];
  EXPECT_TRUE(found.is_found);
  if (found.refused.empty()) {
    EXPECT_GE(found.score_after, found.score_before);
    EXPECT_LT(found.moved_m, 0.001);
  } else {
    EXPECT_NE(found.refused.find("the images agree with the scene's own pose by "),
              std::string::npos);
    EXPECT_TRUE(found.X_PC.isApprox(drawn.X_PC_true, 0));
    EXPECT_EQ(found.depth.offset_m, 0);
    EXPECT_EQ(found.depth.scale, 1);
    EXPECT_EQ(found.moved_m, 0);
    EXPECT_TRUE(std::isnan(found.halves_m));
  }
}

TEST(Calibrate, TheClocksOffsetIsFound) {
  for (const double offset_s : {0.050, -0.030}) {
    SCOPED_TRACE(offset_s);
    DrawnCalibrationData drawn = coarse_arm().draw(
        {.width_px = 320, .height_px = 240, .moves = true, .errors = {.clock_offset_s = offset_s}},
        1);
    disturb(drawn, 0.03, 3 * kDegree, 400);
    const CalibrationResult found = calibrate(drawn.calibration_data);
    expect_found(drawn, found);
    EXPECT_NEAR(found.cameras[0].clock_offset_s, offset_s, 0.002);
    EXPECT_LT(found.cameras[0].sigma_clock_s, 0.005);
    EXPECT_EQ(std::count(found.cameras[0].not_determined.begin(),
                         found.cameras[0].not_determined.end(), "clock_offset_s"),
              0);
  }
}

TEST(Calibrate, AnOffsetThatTheSceneHasIsBuiltUpon) {
  DrawnCalibrationData drawn = coarse_arm().draw(
      {.width_px = 320, .height_px = 240, .moves = true, .errors = {.clock_offset_s = 0.045}}, 2);
  // The stamps stay; what is believed of the joints goes with the offset.
  drawn.camera->clock_offset_s = 0.030;
  for (CalibrationFrame& frame : drawn.camera->frames) {
    const double stamp_s = frame.joints.stamp_s;
    drawn.joints->at(stamp_s + 0.030, kOnlyBetweenSamples, frame.joints);
    frame.joints.stamp_s = stamp_s;
  }
  const CalibrationResult found = calibrate(drawn.calibration_data);
  expect_found(drawn, found);
  EXPECT_NEAR(found.cameras[0].clock_offset_s, 0.045, 0.002);
}

TEST(Calibrate, AnArmThatStandsTellsNoClock) {
  DrawnCalibrationData drawn = coarse_arm().draw(kQuick, 3);
  drawn.camera->has_stamps = true;
  drawn.camera->clock_offset_s = 0.010;
  disturb(drawn, 0.03, 3 * kDegree, 500);
  const CalibrationResult found = calibrate(drawn.calibration_data);
  expect_found(drawn, found);
  EXPECT_EQ(found.cameras[0].clock_offset_s, 0.010) << "it stays";
  EXPECT_EQ(std::count(found.cameras[0].not_determined.begin(),
                       found.cameras[0].not_determined.end(), "clock_offset_s"),
            1);
}

TEST(Calibrate, ADepthErrorOfAPercentIsFound) {
  constexpr double kShare = 0.01;
  DrawnCalibrationData drawn =
      coarse_arm().draw({.width_px = 320, .height_px = 240, .errors = {.depth_share = kShare}}, 2);
  disturb(drawn, 0.05, 5 * kDegree, 600);
  const CalibrationResult found = calibrate(drawn.calibration_data);
  expect_found(drawn, found);
  // Offset and scale stand for each other: what they make of a reading is what counts.
  const DepthError& depth = found.cameras[0].depth;
  const double corrected_m = depth.offset_m + depth.scale * (1 + kShare) * 1.5;
  EXPECT_NEAR(corrected_m / 1.5, 1, 0.003);
}

TEST(Calibrate, AWrongFocalLengthIsRefusedAndTheRightOneTold) {
  for (const double factor : {0.9, 1.1}) {
    SCOPED_TRACE(factor);
    DrawnCalibrationData drawn = coarse_arm().draw({.width_px = 160, .height_px = 120}, 5);
    disturb(drawn, 0.03, 3 * kDegree, 700);
    const double right_px = drawn.camera->camera.fx_px;
    drawn.camera->camera.fx_px *= factor;
    drawn.camera->camera.fy_px *= factor;
    const CameraCalibration found = calibrate(drawn.calibration_data).cameras[0];
    EXPECT_FALSE(found.is_found);
    const std::string before = "with a focal length of ";
    const std::size_t at = found.refused.find(before);
    ASSERT_NE(at, std::string::npos) << found.refused;
    EXPECT_NEAR(std::stod(found.refused.substr(at + before.size())), right_px, 0.04 * right_px)
        << found.refused;
  }
}

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
