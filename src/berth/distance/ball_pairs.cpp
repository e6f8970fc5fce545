#include "berth/distance/ball_pairs.hpp"

#include <map>

#include "berth/robot/kinematics.hpp"

namespace berth::mesh {

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
