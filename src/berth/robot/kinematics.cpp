#include "berth/robot/kinematics.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace berth {
namespace {

Pose joint_motion(const Joint& joint, const std::vector<double>& positions) {
  Pose X = Pose::Identity();
  if (!joint.position_index) return X;
  const double position = joint.multiplier * positions[*joint.position_index] + joint.offset;
  if (joint.type == JointType::prismatic) {
    X.translation() = position * joint.axis_J;
  } else {
    X.linear() = Eigen::AngleAxisd(position, joint.axis_J).toRotationMatrix();
  }
  return X;
}

void require_positions(const RobotModel& model, const std::vector<double>& positions) {
  if (positions.size() != model.joints.size()) {
    throw std::invalid_argument(
        fmt::format("joint state of robot \"{}\": {} positions; expected {}", model.name,
                    positions.size(), model.joints.size()));
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (std::isfinite(positions[i])) continue;
    throw std::invalid_argument(
        fmt::format("joint state of robot \"{}\": joint \"{}\" is {}; expected a finite number",
                    model.name, model.joints[i].name, positions[i]));
  }
}

}  // namespace

void forward_kinematics(const RobotModel& model, const std::vector<double>& positions,
                        RobotPose& pose) {
  require_positions(model, positions);
  pose.X_BL.resize(model.links.size());
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    pose.X_BL[i] = link.parent ? pose.X_BL[*link.parent] * link.joint.X_PJ *
                                     joint_motion(link.joint, positions)
                               : Pose::Identity();
  }
}

void point_jacobian(const RobotModel& model, const RobotPose& pose, std::size_t link,
                    const Eigen::Vector3d& p_B_m, Eigen::Matrix3Xd& jacobian) {
  jacobian.setZero(3, static_cast<Eigen::Index>(model.joints.size()));
  for (std::optional<std::size_t> i = link; i; i = model.links[*i].parent) {
    const Joint& joint = model.links[*i].joint;
    if (!joint.position_index) continue;
    const Pose& X_BL = pose.X_BL[*i];
    const Eigen::Vector3d axis_B = joint.multiplier * (X_BL.linear() * joint.axis_J);
    const bool slides = joint.type == JointType::prismatic;
    jacobian.col(static_cast<Eigen::Index>(*joint.position_index)) +=
        slides ? axis_B : Eigen::Vector3d(axis_B.cross(p_B_m - X_BL.translation()));
  }
}

}  // namespace berth
