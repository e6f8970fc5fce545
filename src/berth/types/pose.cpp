#include "berth/types/pose.hpp"

#include <cmath>
#include <limits>

namespace berth {

Pose unset_pose() {
  Pose X = Pose::Identity();
  X.matrix().topRows<3>().setConstant(std::numeric_limits<double>::quiet_NaN());
  return X;
}

Eigen::Quaterniond rotation_of_rpy(const Eigen::Vector3d& rpy_rad) {
  return Eigen::AngleAxisd(rpy_rad.z(), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(rpy_rad.y(), Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(rpy_rad.x(), Eigen::Vector3d::UnitX());
}

Eigen::Vector3d rpy_of(const Eigen::Matrix3d& R) {
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  const double c = std::cos(yaw);
  const double s = std::sin(yaw);
  return {std::atan2(s * R(0, 2) - c * R(1, 2), c * R(1, 1) - s * R(0, 1)),
          std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0))), yaw};
}

}  // namespace berth
