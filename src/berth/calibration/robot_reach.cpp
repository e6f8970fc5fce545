#include "berth/calibration/robot_reach.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth {
namespace {

constexpr int kDraws = 1000;

/// A link that a joint moves, by its index, and the corners of its bounding box; none where it has
/// no shape.
struct MovedLink {
  std::size_t index;
  std::vector<Eigen::Vector3d> corners_L_m;
};

std::vector<Eigen::Vector3d> corners_of(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> corners;
  if (mesh.empty()) return corners;
  const Eigen::AlignedBox3d box_m = mesh.bounding_box_m().cast<double>();
  for (int i = 0; i < 8; ++i) {
    corners.push_back(box_m.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  }
  return corners;
}

std::vector<MovedLink> moved_links(const RobotModel& model) {
  std::vector<MovedLink> moved;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    if (model.is_moved(i)) moved.push_back({i, corners_of(model.links[i].mesh_L)});
  }
  return moved;
}

double drawn_position(const MovableJoint& joint, RepeatableRandom& random) {
  if (std::isfinite(joint.lower) && std::isfinite(joint.upper)) {
    return random(joint.lower, joint.upper);
  }
  return joint.type == JointType::prismatic ? 0 : random(-EIGEN_PI, EIGEN_PI);
}

}  // namespace

RobotReach robot_reach(const RobotModel& model) {
  const std::vector<MovedLink> moved = moved_links(model);
  if (moved.empty()) return {};
  RepeatableRandom random;
  RobotPose pose;
  RobotReach reach;
  std::vector<double> positions(model.joints.size(), 0);
  forward_kinematics(model, positions, pose);
  reach.center_B_m = pose.X_BL[moved.front().index].translation();
  for (int draw = 0; draw < kDraws; ++draw) {
    for (std::size_t j = 0; j < positions.size(); ++j) {
      positions[j] = drawn_position(model.joints[j], random);
    }
    forward_kinematics(model, positions, pose);
    for (const MovedLink& link : moved) {
      for (const Eigen::Vector3d& corner_L_m : link.corners_L_m) {
        const Eigen::Vector3d at_B_m = pose.X_BL[link.index] * corner_L_m;
        reach.radius_m = std::max(reach.radius_m, (at_B_m - reach.center_B_m).norm());
      }
    }
  }
  return reach;
}

}  // namespace berth
