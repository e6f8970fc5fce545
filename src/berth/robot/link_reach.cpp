#include "berth/robot/link_reach.hpp"

#include <cmath>

namespace berth {

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
