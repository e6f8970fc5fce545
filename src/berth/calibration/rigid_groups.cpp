#include "berth/calibration/rigid_groups.hpp"

#include <algorithm>
#include <map>

namespace berth {
namespace {

/// The link that all of its group hang on, by fixed joints: the first of them.
std::size_t first_of_group(const RobotModel& model, std::size_t link) {
  while (model.links[link].parent && model.links[link].joint.type == JointType::fixed) {
    link = *model.links[link].parent;
  }
  return link;
}

int joints_above(const RobotModel& model, std::size_t link) {
  int joints = 0;
  for (std::optional<std::size_t> at = link; at; at = model.links[*at].parent) {
    joints += model.links[*at].joint.type != JointType::fixed;
  }
  return joints;
}

/// X_FL: the pose of a link in the frame F of the first of its group.
Pose pose_in_group(const RobotModel& model, std::size_t link, std::size_t first) {
  Pose X_FL = Pose::Identity();
  for (; link != first; link = *model.links[link].parent) {
    X_FL = model.links[link].joint.X_PJ * X_FL;
  }
  return X_FL;
}

}  // namespace

std::vector<RigidGroup> moved_groups(const RobotModel& model) {
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t link = 0; link < model.links.size(); ++link) {
    if (model.links[link].role != LinkRole::evaluated) continue;
    if (model.is_moved(link)) members[first_of_group(model, link)].push_back(link);
  }
  std::vector<RigidGroup> groups;
  for (const auto& [first, links] : members) {
    RigidGroup group{links.back(), joints_above(model, first), {}};
    const Pose X_LF = pose_in_group(model, group.link, first).inverse();
    for (const std::size_t link : links) {
      const Pose X_LM = X_LF * pose_in_group(model, link, first);
      for (const Eigen::Vector3f& p_M_m : model.links[link].mesh_L.vertices_m) {
        group.reach_L_m.extend(X_LM * p_M_m.cast<double>());
      }
    }
    if (group.reach_L_m.isEmpty()) continue;
    group.reach_L_m.extend(group.reach_L_m.min() - Eigen::Vector3d::Constant(kReach_m));
    group.reach_L_m.extend(group.reach_L_m.max() + Eigen::Vector3d::Constant(kReach_m));
    groups.push_back(group);
  }
  return groups;
}

}  // namespace berth
