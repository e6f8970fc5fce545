#include "sim/arm.hpp"

#include <fmt/format.h>

#include <numbers>

namespace berth::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

ArmJoint make_joint(double z_m, const Eigen::Vector3d& axis, double limit_deg,
                    double velocity_deg_s) {
  return {{0, 0, z_m}, axis, limit_deg * kDegree, velocity_deg_s * kDegree};
}

}  // namespace

const std::array<ArmJoint, kArmJoints>& arm_joints() {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ(), y = Eigen::Vector3d::UnitY();
  static const std::array<ArmJoint, kArmJoints> joints{
      make_joint(0.110, z, 170, 110), make_joint(0.200, y, 120, 110),
      make_joint(0.200, z, 170, 128), make_joint(0.200, -y, 120, 128),
      make_joint(0.200, z, 170, 204), make_joint(0.190, y, 120, 184),
      make_joint(0.078, z, 170, 184)};
  return joints;
}

std::string arm_link_name(int link) { return fmt::format("arm_link_{}", link); }

std::string arm_joint_name(int joint_index) { return fmt::format("arm_joint_{}", joint_index + 1); }

std::array<Pose, kArmLinks> arm_kinematics(const JointAngles& angle_rad) {
  std::array<Pose, kArmLinks> X_TL;
  X_TL[0] = Pose::Identity();
  for (int i = 0; i < kArmJoints; ++i) {
    const ArmJoint& joint = arm_joints()[i];
    X_TL[i + 1] =
        X_TL[i] * Eigen::Translation3d(joint.offset_m) * rotation(angle_rad[i], joint.axis);
  }
  return X_TL;
}

}  // namespace berth::sim
