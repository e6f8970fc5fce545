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

namespace {

/// As if the link were fixed to its parent.
LinkTwist carried(const LinkTwist& parent, const Eigen::Vector3d& from_parent_B_m) {
  return {parent.linear_B_m_s + parent.angular_B_rad_s.cross(from_parent_B_m),
          parent.angular_B_rad_s};
}

/// What the link's own joint adds. The joint's axis is the same in the frames of joint and link.
void add_joint(const Joint& joint, const Pose& X_BL, double velocity, LinkTwist& twist) {
  const Eigen::Vector3d axis_B = X_BL.linear() * joint.axis_J;
  if (joint.type == JointType::prismatic) {
    twist.linear_B_m_s += velocity * axis_B;
  } else {
    twist.angular_B_rad_s += velocity * axis_B;
  }
}

}  // namespace

void link_twists(const RobotModel& model, const RobotPose& pose, std::span<const double> velocities,
                 std::vector<LinkTwist>& twists) {
  if (velocities.size() != model.joints.size()) {
    throw std::invalid_argument(fmt::format("joint velocities of robot \"{}\": {}; expected {}",
                                            model.name, velocities.size(), model.joints.size()));
  }
  twists.resize(model.links.size());
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    if (!link.parent) {
      twists[i] = {};
      continue;
    }
    const Pose& X_BL = pose.X_BL[i];
    twists[i] =
        carried(twists[*link.parent], X_BL.translation() - pose.X_BL[*link.parent].translation());
    if (link.joint.position_index) {
      add_joint(link.joint, X_BL, link.joint.multiplier * velocities[*link.joint.position_index],
                twists[i]);
    }
  }
}

std::vector<ChainJoint> joint_chain(const RobotModel& model, std::size_t link) {
  std::vector<ChainJoint> chain;
  for (std::optional<std::size_t> i = link; i; i = model.links[*i].parent) chain.push_back({*i, 0});
  return chain;
}

void find_reach(const RobotModel& model, const RobotPose& pose, double radius_m,
                std::span<const double> slides_m, std::span<ChainJoint> chain) {
  double length_m = radius_m;
  for (ChainJoint& at : chain) {
    const Link& link = model.links[at.link];
    const bool slides = link.joint.type == JointType::prismatic;
    at.reach_m = slides ? 1.0 : length_m;
    if (!link.parent) return;
    length_m += (pose.X_BL[at.link].translation() - pose.X_BL[*link.parent].translation()).norm();
    if (slides && !slides_m.empty() && link.joint.position_index) {
      length_m += std::abs(link.joint.multiplier) * slides_m[*link.joint.position_index];
    }
  }
}

}  // namespace berth
