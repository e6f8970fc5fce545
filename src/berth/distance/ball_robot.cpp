#include "berth/distance/ball_robot.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>

#include "berth/robot/kinematics.hpp"

namespace berth::mesh {
namespace {

/// The frame that a link is fixed to, and where it stands in it.
struct Place {
  int frame = -1;
  Pose X_FL = Pose::Identity();
};

BallFrame frame_of(const Joint& joint, const Place& parent) {
  BallFrame frame;
  frame.parent = parent.frame;
  frame.joint = static_cast<int>(*joint.position_index);
  frame.multiplier = static_cast<float>(joint.multiplier);
  frame.offset = static_cast<float>(joint.offset);
  frame.is_slide = joint.type == JointType::prismatic;
  const Pose X_PJ = parent.X_FL * joint.X_PJ;
  const Eigen::Matrix3d R = X_PJ.linear();
  const Eigen::Vector3d axis = joint.axis_J.normalized();
  // Rodrigues.
  const Eigen::Matrix3d along = axis * axis.transpose();
  Eigen::Matrix3d cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  frame.of_none = (frame.is_slide ? R : Eigen::Matrix3d(R * along)).cast<float>();
  frame.of_cos.setZero();
  frame.of_sin.setZero();
  if (!frame.is_slide) {
    frame.of_cos = (R * (Eigen::Matrix3d::Identity() - along)).cast<float>();
    frame.of_sin = (R * cross).cast<float>();
  }
  frame.at_m = X_PJ.translation().cast<float>();
  frame.axis = (R * axis).cast<float>();
  frame.slide = frame.is_slide ? frame.axis : Eigen::Vector3f(Eigen::Vector3f::Zero());
  return frame;
}

}  // namespace

BallRobot build_ball_robot(const RobotModel& model) {
  BallRobot robot;
  robot.joint_count = static_cast<int>(model.joints.size());
  std::vector<Place> places;
  std::vector<Pose> X_FL;
  for (const Link& link : model.links) {
    const Place parent = link.parent ? places[*link.parent] : Place();
    if (link.parent && link.joint.position_index) {
      robot.frames.push_back(frame_of(link.joint, parent));
      places.push_back({static_cast<int>(robot.frames.size()) - 1, Pose::Identity()});
    } else {
      places.push_back({parent.frame, parent.X_FL * link.joint.X_PJ});
    }
  }
  for (std::size_t i = model.evaluated_links.size(); i-- > 0;) {
    const std::size_t index = model.evaluated_links[i];
    if (!model.is_moved(index) || model.links[index].mesh_L.empty()) continue;
    robot.links.push_back({static_cast<LinkId>(i + 1), places[index].frame, {}});
    X_FL.push_back(places[index].X_FL);
  }
  tbb::parallel_for(std::size_t{0}, robot.links.size(), [&](std::size_t i) {
    TriangleMesh mesh_F;
    const std::size_t index = model.evaluated_links[robot.links[i].id - 1];
    mesh_F.append(model.links[index].mesh_L, X_FL[i]);
    robot.links[i].balls = build_link_balls(mesh_F);
  });
  return robot;
}

BallPairs build_ball_pairs(const RobotModel& model, const KnownModel& known, const BallRobot& balls,
                           const Eigen::Vector3d& middle_B_m, double reach_m) {
  BallPairs out;
  out.others.assign(balls.links.size(), false);
  std::map<std::size_t, std::size_t> place_of;
  for (std::size_t l = 0; l < balls.links.size(); ++l) {
    place_of[model.evaluated_links[balls.links[l].id - 1]] = l;
  }
  // By what does not move: the links that may not touch it.
  std::map<std::size_t, std::vector<bool>> asking;
  for (const auto& [a, b] : known.pairs) {
    const std::size_t link = place_of.at(known.bodies[a].link), other = known.bodies[b].link;
    if (known.bodies[b].is_asked) {
      out.moved.push_back({link, place_of.at(other)});
    } else if (model.is_moved(other)) {
      out.others[link] = true;
    } else {
      std::vector<bool>& asks = asking[other];
      asks.resize(balls.links.size(), false);
      asks[link] = true;
    }
  }
  // What the same links may not touch stands in one field.
  std::map<std::vector<bool>, std::vector<TriangleMesh>> surfaces_B;
  RobotPose pose;
  forward_kinematics(model, std::vector<double>(model.joints.size(), 0.0), pose);
  for (const auto& [link, asks] : asking) {
    surfaces_B[asks].emplace_back().append(model.links[link].mesh_L, pose.X_BL[link]);
  }
  for (const auto& [asks, meshes_B] : surfaces_B) {
    auto still = std::make_unique<BallPairs::Still>();
    still->field.build(meshes_B, middle_B_m, reach_m);
    still->asks = asks;
    out.still.push_back(std::move(still));
  }
  return out;
}

}  // namespace berth::mesh
