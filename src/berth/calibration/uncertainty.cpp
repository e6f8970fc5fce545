#include "berth/calibration/uncertainty.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace berth {
namespace {

/// A joint's zero is told where its deviation is below this: 0.17 degrees.
constexpr double kCertainJoint = 0.003;

Eigen::MatrixXd covariance_of(const FitResult& fitted) { return fitted.information.inverse(); }

/// The small move of the robot before the camera from one estimate to another, as the fit's
/// unknowns have it.
Eigen::VectorXd difference(const CameraEstimate& from, const CameraEstimate& to,
                           const Eigen::Vector3d& pivot_C_m) {
  const Pose X_CC = to.X_PC.inverse() * from.X_PC;
  const Eigen::AngleAxisd turn(X_CC.linear());
  Eigen::VectorXd by(kCameraUnknowns);
  by.segment<3>(kRotation) = turn.angle() * turn.axis();
  by.segment<3>(kMove) = X_CC * pivot_C_m - pivot_C_m;
  by[kDepthOffset] = to.depth_offset_m - from.depth_offset_m;
  by[kDepthScale] = to.depth_scale - from.depth_scale;
  by[kDilation] = to.dilation_px - from.dilation_px;
  by[kClock] = to.clock_shift_s - from.clock_shift_s;
  return by;
}

/// How many times the equations' variance the halves' difference has. Each half has twice the
/// variance of the whole, their difference four times.
double excess(const Eigen::VectorXd& halves, const Eigen::VectorXd& variance, int first,
              int count) {
  double sum = 0;
  for (int i = first; i < first + count; ++i) sum += halves[i] * halves[i] / (4 * variance[i]);
  return std::max(1.0, sum / count);
}

}  // namespace

CameraDeviation deviation_of(const FitResult& fitted, const FitResult& even, const FitResult& odd,
                             std::size_t camera) {
  const auto first = static_cast<Eigen::Index>(camera) * kCameraUnknowns;
  const Eigen::MatrixXd covariance =
      covariance_of(fitted).block(first, first, kCameraUnknowns, kCameraUnknowns);
  const Eigen::VectorXd variance = covariance.diagonal();
  const CameraEstimate& estimate = fitted.estimate.cameras[camera];
  const Eigen::Vector3d pivot_C_m = fitted.pivot_C_m[camera];
  const Eigen::VectorXd halves =
      difference(even.estimate.cameras[camera], odd.estimate.cameras[camera], pivot_C_m);
  const double pose_excess = excess(halves, variance, kRotation, 6);

  // Where the robot turns by w about the pivot c and moves by v, the camera turns by -w and its
  // origin moves by w x c - v, in C.
  Eigen::Matrix<double, 6, 6> to_camera = Eigen::Matrix<double, 6, 6>::Zero();
  const Eigen::Matrix3d R_PC = estimate.X_PC.linear();
  Eigen::Matrix3d cross;
  cross << 0, -pivot_C_m.z(), pivot_C_m.y(), pivot_C_m.z(), 0, -pivot_C_m.x(), -pivot_C_m.y(),
      pivot_C_m.x(), 0;
  to_camera.topLeftCorner<3, 3>() = -R_PC * cross;
  to_camera.topRightCorner<3, 3>() = -R_PC;
  to_camera.bottomLeftCorner<3, 3>() = -R_PC;
  const Eigen::Matrix<double, 6, 6> pose =
      pose_excess * to_camera * covariance.topLeftCorner<6, 6>() * to_camera.transpose();
  const auto deviation = [&](int unknown) {
    return std::sqrt(variance[unknown] * excess(halves, variance, unknown, 1));
  };
  return {pose.diagonal().head<3>().cwiseSqrt(),
          pose.diagonal().tail<3>().cwiseSqrt(),
          deviation(kClock),
          deviation(kDepthOffset),
          deviation(kDepthScale),
          std::sqrt(pose_excess * variance.segment<3>(kMove).sum())};
}

std::vector<bool> determined_joints(const FitResult& fitted) {
  const auto joints = static_cast<Eigen::Index>(fitted.estimate.joint_shift.size());
  const Eigen::VectorXd variance = covariance_of(fitted).diagonal().tail(joints);
  std::vector<bool> determined;
  for (const double one : variance) determined.push_back(std::sqrt(one) < kCertainJoint);
  return determined;
}

}  // namespace berth
