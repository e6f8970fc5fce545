// The arm's kinematics. It is written down here a second time on purpose, not read back through the
// library's URDF code: the bundled truth must not share its mistakes.
#pragma once

#include <array>
#include <string>

#include "sim/shapes.hpp"

namespace berth::sim {

inline constexpr int kArmJoints = 7;
inline constexpr int kArmLinks = kArmJoints + 1;
inline constexpr const char* kTableLink = "table";

/// Joint i turns link i + 1 about `axis`, at `offset_m` in link i's frame.
struct ArmJoint {
  Eigen::Vector3d offset_m;
  Eigen::Vector3d axis;
  double limit_rad;
  double velocity_rad_s;
};

using JointAngles = std::array<double, kArmJoints>;

/// Proportions and limits of a KUKA LWR 4: 0.310, 0.400, 0.390 and 0.078 m between base, shoulder,
/// elbow, wrist and flange; axes about z and y in turn.
const std::array<ArmJoint, kArmJoints>& arm_joints();

/// "arm_link_0" ... "arm_link_7", "arm_joint_1" ... "arm_joint_7".
std::string arm_link_name(int link);
std::string arm_joint_name(int joint_index);

/// X_TL of each link: its frame in that of the table, which is the arm's own base frame. Angles in
/// rad.
std::array<Pose, kArmLinks> arm_kinematics(const JointAngles& angle_rad);

}  // namespace berth::sim
