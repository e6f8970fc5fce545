#include "sim/known_check.hpp"

#include <algorithm>

#include "sim/random.hpp"

namespace berth::sim {
namespace {

bool are_neighbours(const RobotModel& model, std::size_t link, std::size_t other) {
  return model.links[link].parent == other || model.links[other].parent == link;
}

}  // namespace

KnownCheck::KnownCheck(const RobotModel& model) : trees_(build_link_trees(model)) {
  for (const Link& link : model.links) hulls_.push_back(hull_points(link.mesh_L));
  for (std::size_t link = 0; link < model.links.size(); ++link) {
    if (!model.is_moved(link)) continue;
    for (std::size_t other = 0; other < model.links.size(); ++other) {
      const bool is_second = model.is_moved(other) && other <= link;
      if (is_second || !trees_[link] || !trees_[other] || are_neighbours(model, link, other)) {
        continue;
      }
      const Pair pair{link, other};
      if (!always_touches(model, pair)) pairs_.push_back(pair);
    }
  }
}

bool KnownCheck::always_touches(const RobotModel& model, const Pair& pair) const {
  // Less is a gap of a joint.
  constexpr double kApart_m = 0.001;
  constexpr int kDrawn = 200;
  Random random(1);
  RobotPose pose;
  std::vector<double> position(model.joints.size());
  for (int i = 0; i < kDrawn; ++i) {
    for (std::size_t j = 0; j < position.size(); ++j) {
      position[j] = random(model.joints[j].lower, model.joints[j].upper);
    }
    forward_kinematics(model, position, pose);
    if (measure(pair, pose) > kApart_m) return false;
  }
  return true;
}

double KnownCheck::measure(const Pair& pair, const RobotPose& pose) const {
  return closest_points(trees_[pair.link], pose.X_BL[pair.link], trees_[pair.other],
                        pose.X_BL[pair.other])
      .distance_m;
}

void KnownCheck::add(const RobotPose& pose, double fastest_m_s) {
  constexpr double kTolerance_m = 0.002;
  for (Pair& pair : pairs_) {
    const Pose X_OL = pose.X_BL[pair.other].inverse() * pose.X_BL[pair.link];
    const double at_least_m =
        pair.distance_m - greatest_displacement_m(hulls_[pair.link], pair.X_OL, X_OL);
    if (at_least_m > 0 && at_least_m >= least_m_ - kTolerance_m) continue;
    pair.distance_m = measure(pair, pose);
    pair.X_OL = X_OL;
    least_m_ = std::min(least_m_, pair.distance_m);
    if (pair.distance_m <= 0) contact_m_s_ = std::max(contact_m_s_, fastest_m_s);
  }
}

}  // namespace berth::sim
