#include "berth/robot/link_twists.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace berth {
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

}  // namespace berth
