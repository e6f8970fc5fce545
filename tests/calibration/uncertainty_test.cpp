#include "berth/calibration/uncertainty.hpp"

#include <gtest/gtest.h>

#include "berth/fit/estimate.hpp"

namespace berth {
namespace {

/// A fit whose unknowns have these deviations, each on its own.
FitResult fit_with(double turn_rad, double move_m, double clock_s,
                   const std::vector<double>& joints = {}) {
  const auto count = static_cast<Eigen::Index>(joints.size());
  Eigen::VectorXd deviation(kCameraUnknowns + count);
  deviation.setConstant(1e-3);
  deviation.segment<3>(kRotation).setConstant(turn_rad);
  deviation.segment<3>(kMove).setConstant(move_m);
  deviation[kClock] = clock_s;
  for (Eigen::Index j = 0; j < count; ++j) deviation[kCameraUnknowns + j] = joints[j];
  FitResult fitted;
  fitted.estimate.cameras = {{.X_PC = Pose::Identity()}};
  fitted.estimate.joint_shift.assign(joints.size(), 0.0);
  fitted.information = deviation.array().square().inverse().matrix().asDiagonal();
  fitted.pivot_C_m = {Eigen::Vector3d::Zero()};
  return fitted;
}

TEST(Uncertainty, HalvesThatAgreeLeaveWhatTheEquationsSay) {
  const FitResult fitted = fit_with(0.002, 0.001, 0.0005);
  const CameraDeviation found = deviation_of(fitted, fitted, fitted, 0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.xyz_m[i], 0.001, 1e-9);
    EXPECT_NEAR(found.rotation_rad[i], 0.002, 1e-9);
  }
  EXPECT_NEAR(found.clock_s, 0.0005, 1e-9);
  EXPECT_NEAR(found.robot_m, 0.001 * std::sqrt(3), 1e-9);
}

TEST(Uncertainty, ATurnAboutADistantMiddleMovesTheCamera) {
  FitResult fitted = fit_with(0.002, 1e-6, 0.0005);
  fitted.pivot_C_m = {Eigen::Vector3d(0, 0, 1.5)};
  const CameraDeviation found = deviation_of(fitted, fitted, fitted, 0);
  EXPECT_NEAR(found.xyz_m.x(), 0.003, 1e-6);
  EXPECT_NEAR(found.xyz_m.y(), 0.003, 1e-6);
  EXPECT_LT(found.xyz_m.z(), 1e-5);
  // In the parent's axes, not the camera's.
  fitted.estimate.cameras[0].X_PC = Pose(Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitY()));
  EXPECT_LT(deviation_of(fitted, fitted, fitted, 0).xyz_m.x(), 1e-5);
}

TEST(Uncertainty, HalvesThatDifferSayMoreThanTheEquations) {
  const FitResult fitted = fit_with(0.002, 0.001, 0.0005);
  FitResult even = fitted;
  FitResult odd = fitted;
  even.estimate.cameras[0].clock_shift_s = 0.010;
  odd.estimate.cameras[0].clock_shift_s = -0.010;
  even.estimate.cameras[0].X_PC.translation().x() = 0.03;
  const CameraDeviation found = deviation_of(fitted, even, odd, 0);
  EXPECT_NEAR(found.clock_s, 0.010, 1e-9) << "half of the difference";
  // A difference in x, spread over the pose's six unknowns.
  EXPECT_NEAR(found.xyz_m.y(), 0.015 / std::sqrt(6), 1e-6);
  EXPECT_GT(found.robot_m, 0.010);
}

TEST(Uncertainty, JointsAreTheLastUnknowns) {
  const std::vector<bool> found = determined_joints(fit_with(1, 1, 1, {0.02, 0.002, 0.004}));
  EXPECT_EQ(found, (std::vector{false, true, false}));
}

}  // namespace
}  // namespace berth
